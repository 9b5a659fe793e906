"""The page of penumbra compare in a browser: no errors, sliders, zoom, tables, and how it looks."""

import browser
from desktop import wait_for
from pictures import scene
from support import main, temporary_folder, run

EQUAL = "brute_force:sampling.seed=32768"  # as the reference, so that nothing differs
TECHNIQUES = f"none,hard,pcf,pcss,{EQUAL}"
HOSTILE = "<script>alert('a&b')</script>"


class Page(browser.PageTest):
    @classmethod
    def make_page(cls):
        folder = temporary_folder()
        cls.addClassCleanup(folder.cleanup)
        cls.report = f"{folder.name}/report"
        cls.page = f"{cls.report}/index.html"
        # A scene may be called anything that a file can be.
        cls.scene = f"{folder.name}/{HOSTILE.replace('/', '_')}.glb"
        with open(cls.scene, "wb") as file:
            file.write(scene("posts").read_bytes())
        result = run("compare", cls.scene, scene("steps"), "-o", cls.report, "--technique", TECHNIQUES, "--reference",
                     "brute_force", "--set", "sun.angle=4", "--size", "320x180", "--no-cache")
        assert result.returncode == 0, result.stderr

    def script(self, text, *arguments):
        return self.browser.script(text, *arguments)

    def column(self, index):
        return self.script("return Array.from(document.querySelectorAll('section:first-of-type .sortable tbody tr'),"
                           "row => row.cells[arguments[0]].firstChild.data)", index)

    def splits(self):
        return self.script("return Array.from(document.querySelectorAll('.slider'),"
                           "slider => parseFloat(getComputedStyle(slider).getPropertyValue('--split')))")

    def place(self):
        return self.script("const style = getComputedStyle(document.documentElement);"
                           "return ['zoom', 'x', 'y'].map(name => Number(style.getPropertyValue('--' + name)))")

    def test_it_loads_without_a_word_in_the_console(self):
        self.assertEqual(self.script("return document.title"),
                         f"Shadow techniques on {HOSTILE.replace('/', '_')}, steps")
        self.assertEqual(self.script("return document.scripts.length"), 1)

    def test_it_asks_nothing_of_the_network(self):
        self.assertEqual(self.script("return performance.getEntriesByType('resource')"
                                     ".map(entry => entry.name).filter(name => !name.startsWith('data:'))"), [])

    def test_every_picture_is_there(self):
        sizes = self.script("return Promise.all(Array.from(document.images, image => image.decode().then("
                            "() => [image.naturalWidth, image.naturalHeight])))")
        self.assertEqual(len(sizes), 2 * 5 * 5)  # scenes, techniques, pictures
        self.assertTrue(all(size == [320, 180] for size in sizes), sizes)
        self.assertTrue(all(self.script("return Array.from(document.images, image => image.alt)")))

    def errors(self):
        """The first error map's pixels, RGBA, and the texts of its legend."""
        pixels = self.script(
            "const image = document.querySelector('.error-map .pane img'); return image.decode().then(() => {"
            "const canvas = document.createElement('canvas'); canvas.width = 320; canvas.height = 180;"
            "const context = canvas.getContext('2d'); context.drawImage(image, 0, 0);"
            "return Array.from(context.getImageData(0, 0, 320, 180).data); })")
        return pixels, self.script("return Array.from(document.querySelectorAll('.error-map:first-of-type .ends span'),"
                                   "label => label.textContent)")[:3]

    def choose_range(self, value):
        self.script("const select = document.getElementById('error-range'); select.value = arguments[0];"
                    "select.dispatchEvent(new Event('change'));", value)
        texts = "map => [map.querySelector('.ends span').textContent, map.dataset.range]"
        wait_for(lambda: all(text == f"−{value or own} too dark" for text, own in self.script(
            f"return Array.from(document.querySelectorAll('.error-map'), {texts})")), "every legend")
        return self.errors()

    def test_the_reader_chooses_the_range_of_all_error_maps(self):
        drawn, labels = self.errors()
        own = self.script("return document.querySelector('.error-map').dataset.range")
        self.assertEqual(labels, [f"−{own} too dark", "0", f"+{own} too bright"])
        again, _ = self.choose_range(own)
        # The codes are finest near 0; elsewhere they are as far apart as eight bits allow.
        self.assertLess(max(abs(a - b) for a, b in zip(drawn, again)), 24)
        self.assertLess(sum(abs(a - b) for a, b in zip(drawn, again)) / len(drawn), 1)
        deep_red, grey = (178, 24, 43), (72, 75, 82)

        def count(pixels, color):
            return sum(tuple(pixels[at:at + 3]) == color for at in range(0, len(pixels), 4))

        least, labels = self.choose_range("0.01")
        self.assertEqual(labels, ["−0.01 too dark", "0", "+0.01 too bright"])
        self.assertEqual(count(least, grey), count(drawn, grey))
        widest, _ = self.choose_range("1")
        self.assertGreaterEqual(count(least, deep_red), count(widest, deep_red))
        self.assertNotEqual(least, widest)
        self.assertEqual(self.choose_range("")[0], drawn)

    def test_keys_move_a_divider_and_all_with_it(self):
        slider = self.browser.one(".slider input")
        self.assertEqual(set(self.splits()), {50})
        self.browser.press(slider, "right", "right", "right", "right")
        self.assertEqual(set(self.splits()), {52})
        self.browser.press(slider, "home")
        self.assertEqual(set(self.splits()), {0})

    def test_a_divider_moves_alone_if_asked_to(self):
        self.browser.click(self.browser.one("#together"))
        self.browser.press(self.browser.all(".slider input")[1], "end")
        splits = self.splits()
        self.assertEqual((splits[1], set(splits[:1] + splits[2:])), (100, {50}))

    def test_the_mouse_drags_the_handle(self):
        slider = self.browser.one(".slider input")
        self.script("arguments[0].scrollIntoView({block: 'center'})", {browser.ELEMENT: slider})
        self.browser.drag(slider, 60, 0)
        self.assertGreater(min(self.splits()), 60)

    def test_what_the_divider_uncovers_is_the_reference(self):
        clip = "return getComputedStyle(document.querySelector('.slider .over')).clipPath"
        self.assertEqual(self.script(clip), "inset(0px 0px 0px 50%)")
        self.browser.press(self.browser.one(".slider input"), "home")
        self.assertEqual(self.script(clip), "inset(0px 0px 0px 0%)")
        self.assertTrue(self.script("return document.querySelector('.slider .over img').alt.includes('brute_force')"))

    def test_buttons_zoom_all_pictures_alike(self):
        widths = "return Array.from(document.images, image => Math.round(image.getBoundingClientRect().width /" \
                 "image.closest('.pane').getBoundingClientRect().width))"
        for zoom in (2, 4, 1):
            self.browser.click(self.browser.one(f"[data-zoom='{zoom}']"))
            self.assertEqual(set(self.script(widths)), {zoom})
            pressed = self.script("return Array.from(document.querySelectorAll('[data-zoom]'), b => b.ariaPressed)")
            self.assertEqual(pressed, [str(zoom == one).lower() for one in (1, 2, 4)])
            rendering = self.script("return getComputedStyle(document.images[0]).imageRendering")
            self.assertEqual(rendering, "auto" if zoom == 1 else "pixelated")

    def test_a_drag_and_the_arrow_keys_pan(self):
        self.browser.click(self.browser.one("[data-zoom='2']"))
        self.assertEqual(self.place(), [2, 0.25, 0.25])
        view = self.browser.one(".view")
        self.browser.press(view, "right", "down")
        self.assertEqual([round(value, 3) for value in self.place()], [2, 0.3, 0.3])
        self.browser.press(view, *["left"] * 20)
        self.assertEqual(self.place()[1], 0)  # not past the edge
        error_map = self.browser.one(".pane:not(.slider) .view")
        self.script("arguments[0].scrollIntoView({block: 'center'})", {browser.ELEMENT: error_map})
        self.browser.drag(error_map, -40, 0)
        self.assertGreater(self.place()[1], 0.02)
        self.assertEqual(set(self.splits()), {50})

    def test_a_title_sorts_by_number_and_back(self):
        button = self.browser.all("section:first-of-type .sortable thead button")[3]  # PSNR in the penumbra
        before = self.column(3)
        self.assertIn("∞", before)
        self.browser.click(button)
        numbers = [float(text.replace("∞", "inf")) for text in self.column(3)]
        self.assertEqual(numbers, sorted(numbers))
        head = "return document.querySelectorAll('section:first-of-type .sortable thead th')[3].ariaSort"
        self.assertEqual(self.script(head), "ascending")
        self.browser.press(button, "enter")
        self.assertEqual([float(text.replace("∞", "inf")) for text in self.column(3)], numbers[::-1])
        self.assertEqual(self.script(head), "descending")
        self.assertEqual(sorted(self.column(3)), sorted(before))

    def test_names_sort_as_text_and_one_column_at_a_time(self):
        buttons = self.browser.all("section:first-of-type .sortable thead button")
        self.browser.click(buttons[1])
        self.browser.click(buttons[0])
        self.assertEqual(self.column(0), sorted(TECHNIQUES.split(",")))
        self.assertEqual(len(self.browser.all("section:first-of-type [aria-sort]")), 1)

    def test_the_best_of_a_column_is_marked(self):
        best = self.script("return Array.from(document.querySelectorAll('section:first-of-type td.best'),"
                           "cell => cell.parentElement.cells[0].textContent + ' ' + cell.cellIndex)")
        self.assertIn(f"{EQUAL} 3", best)
        self.assertIn("none 1", best)

    def test_tables_and_plots_can_be_used_on_a_narrow_screen(self):
        self.browser.resize(400, 800)
        self.assertEqual(self.script("return document.documentElement.scrollWidth"), 400)
        # The name of a technique takes a third of the width, however long or short it is.
        widths = self.script("return Array.from(document.querySelectorAll('.sortable tbody th'),"
                             "cell => cell.getBoundingClientRect().width)")
        self.assertLess(max(widths), 180)
        self.assertGreater(min(widths), 120)
        caption = self.script("return document.querySelector('.sortable caption span').getBoundingClientRect().right")
        self.assertLess(caption, 400)
        # Text of a plot is as large as it can be read, and the plot scrolls.
        tick = self.script("return document.querySelector('.plot .tick').getBoundingClientRect().height")
        self.assertGreater(tick, 11)
        self.assertTrue(self.script("const plot = document.querySelector('.plot'); plot.scrollLeft = 9999;"
                                    "return plot.scrollLeft > 100"))

    def test_an_option_is_never_split(self):
        for width in range(330, 480, 10):
            self.browser.resize(width, 800)
            heights = self.script("return Array.from(document.querySelectorAll('code .option'),"
                                  "option => option.getClientRects().length)")
            self.assertGreater(len(heights), 5)
            self.assertEqual(set(heights), {1}, width)

    def test_the_command_can_be_copied(self):
        button = self.browser.one("button.copy")
        self.browser.click(button)
        # The browser answers the page's request for the clipboard later.
        wait_for(lambda: self.browser.text(button) in ("Copied", "Selected"), "the button's answer")
        self.assertTrue(self.script("return document.querySelector('code').textContent")
                        .startswith("penumbra compare '"))

    def test_nothing_is_wider_than_the_page(self):
        for width in (1280, 400, 320):
            self.browser.resize(width, 800)
            self.assertEqual(self.script("return document.documentElement.scrollWidth"), width)

    def test_screenshots(self):
        folder = browser.results_folder()
        for name, width, dark in (("wide", 1280, False), ("dark", 1280, True), ("narrow", 400, False)):
            self.browser.resize(width, 800)
            self.browser.set_dark(dark)
            self.browser.screenshot(folder / f"compare-{name}.png")
            self.browser.screenshot(folder / f"compare-{name}-whole.png", whole=True)
            paper = self.script("return getComputedStyle(document.body).backgroundColor")
            self.assertEqual(paper, "rgb(19, 21, 25)" if dark else "rgb(247, 247, 245)")
        self.browser.set_dark(False)


if __name__ == "__main__":
    main()
