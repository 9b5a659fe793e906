"""penumbra view and its window: sizes, minimising, screens with twice the dots."""

import shutil
import signal

from desktop import LEFT, Desktop
from support import TestCase, main
from viewer import Viewer
from window import NO_SMOOTH_EDGES, SMALL_MAPS, STEPS, WindowTest


def width(box):
    return box[2] - box[0]


def height(box):
    return box[3] - box[1]


class Size(WindowTest):
    def resize(self, viewer, *size):
        self.desktop.xdotool("windowsize", viewer.window, *size)

    def test_the_picture_follows_the_window(self):
        with self.view(STEPS) as viewer:
            before = viewer.rest()
            room = 800 - width(viewer.box("picture"))
            for size in ((1000, 500), (700, 640), (800, 600)):
                self.resize(viewer, *size)
                viewer.wait_for(lambda size=size: width(viewer.box("picture")) == size[0] - room, "the new width")
                picture = viewer.rest()
                self.assertEqual(picture.width, size[0] - room)
                self.assertGreater(len(picture.colors()), 30)
            self.assertEqual(picture, before)

    def test_the_picture_is_finished_while_a_field_takes_text(self):
        with self.view(STEPS) as viewer:
            viewer.point_at("search")
            before = viewer.seen("search")
            self.desktop.xdotool("click", LEFT)
            viewer.wait_for(lambda: viewer.seen("search") != before, "a field that takes text")
            room = 800 - width(viewer.box("picture"))
            self.resize(viewer, 1000, 600)
            viewer.wait_for(lambda: width(viewer.box("picture")) == 1000 - room, "the new width")
            self.assertGreater(len(viewer.rest().colors()), 30)
            viewer.type("cascades.count")
            viewer.wait_for(lambda: viewer.has("cascades.count"), "the parameter that was searched for")

    def test_a_slash_on_any_keyboard_and_ctrl_f_search(self):
        with self.view(STEPS) as viewer:
            viewer.rest()
            for layout, key in (("us", "slash"), ("de", "shift+7"), ("us", "ctrl+f")):
                with self.subTest(layout=layout, key=key):
                    self.desktop.keyboard(layout)
                    viewer.open_tab("Scene", "eye")
                    viewer.press(key, lambda: viewer.has("search"), "the search")
                    viewer.follow()
                    viewer.type("cascades.count")
                    viewer.wait_for(lambda: viewer.has("cascades.count") and not viewer.has("maps.layers"),
                                    "what was searched for")
                    self.assertFalse(viewer.has("messages"))
                    viewer.tap("Escape")
                    viewer.follow()

    def test_windows_too_small_for_anything(self):
        with self.view(STEPS) as viewer:
            before = viewer.rest()
            for size in ((300, 200), (60, 40), (1, 1), (1200, 3), (3, 700)):
                self.resize(viewer, *size)
                viewer.wait_for(lambda size=size: self.desktop.client.size(viewer.window) == size, "the new size")
                viewer.follow()
                viewer.wait_for(lambda: viewer.has("idle"), "a finished picture")
            self.resize(viewer, 800, 600)
            viewer.wait_for(lambda: viewer.rest() == before, "the first picture")

    def test_a_window_that_is_resized_while_it_draws(self):
        with self.view(STEPS) as viewer:
            before = viewer.rest()
            # One xdotool for all: to start one for each takes longer than a frame, and half of the processor's time.
            self.desktop.xdotool(*[word for size in ((1, 1), (1200, 300)) * 150
                                   for word in ("windowsize", viewer.window, *size, "sleep", 0.03)])
            self.resize(viewer, 800, 600)
            viewer.wait_for(lambda: viewer.rest() == before, "the first picture")

    def test_it_is_minimised_and_comes_back(self):
        with self.view(STEPS) as viewer:
            before = viewer.rest()
            self.desktop.xdotool("windowminimize", viewer.window)
            viewer.wait_for(lambda: self.desktop.find_window(viewer.process.pid) is None, "an icon")
            self.desktop.xdotool("windowactivate", viewer.window)
            viewer.wait_for(lambda: self.desktop.find_window(viewer.process.pid), "the window")
            viewer.wait_for(lambda: viewer.rest() == before, "the picture as it was")
            viewer.choose("technique", "none")
            viewer.changed(before)

    def test_it_ends_while_it_is_minimised(self):
        with self.view(STEPS) as viewer:
            self.desktop.xdotool("windowminimize", viewer.window)
            viewer.wait_for(lambda: self.desktop.find_window(viewer.process.pid) is None, "an icon")
            self.assertEqual(viewer.signal(signal.SIGTERM), 128 + signal.SIGTERM)


class Panel(WindowTest):
    def test_its_edge_and_the_scale_are_dragged_and_chosen_and_kept(self):
        home = self.folder / "home"
        home.mkdir()
        with self.view(STEPS, home=home, size=(1000, 600)) as viewer:
            left, height_before = viewer.box("picture")[0], height(viewer.box("technique"))
            x, y = viewer.middle("panel edge")
            self.assertLess(abs(x - left), 2)
            self.desktop.xdotool("mousemove", "--window", viewer.window, x, y, "mousedown", 1)
            viewer.follow()
            viewer.move(x + 120, y)
            viewer.follow()
            self.desktop.xdotool("mouseup", 1)
            viewer.wait_for(lambda: viewer.box("picture")[0] == x + 120, "a wider panel")
            self.assertGreater(len(viewer.rest().colors()), 30)
            viewer.click("menu View", lambda: viewer.has("menu Interface scale"), "the menu")
            viewer.click("menu Interface scale", lambda: viewer.has("menu=125 %"), "the scales")
            viewer.click("menu=125 %", lambda: not viewer.has("menu=125 %"), "the menu to close")
            viewer.wait_for(lambda: height(viewer.box("technique")) > height_before, "a larger interface")
            self.assertAlmostEqual(height(viewer.box("technique")) / height_before, 1.25, delta=0.08)
            viewer.rest()
            wanted = viewer.box("panel edge"), viewer.box("technique")
            viewer.tap("Escape")
            self.assertEqual(viewer.exit_code(), 0)
        with self.view(STEPS, home=home, size=(1000, 600)) as viewer:
            self.assertEqual((viewer.box("panel edge"), viewer.box("technique")), wanted)


FAR = "--eye=-123456.789,-1234.567,1234.5678", "--target=-1234567.8,1234567.8,-1234567.8"


def clipped(viewer):
    """What the window cuts off, as the layout names it, once nothing moves any more."""
    def names():
        return [name for name in viewer.layout() if name.startswith("clipped ")]

    viewer.leave()
    viewer.follow()
    if names():
        viewer.rest()  # a window that has just got another size draws few frames while a picture is in the works
    return names()


class Narrow(WindowTest):
    """Nothing is cut off, from a width of 420 pixels."""

    SIZES = (420, 600), (560, 420), (620, 500), (1280, 720)
    TABS = {"Shadow": "search", "Scene": "eye", "Inspect": "shown list", "Compare": "compare", "Cost": "vsync",
            "Files": "with aovs"}
    LOOK = "--technique", "pcf", "--set", "sun.angle=2"

    def each_size(self, viewer, sizes=SIZES):
        for size in sizes:
            self.desktop.xdotool("windowsize", viewer.window, *size)
            viewer.wait_for(lambda size=size: self.desktop.client.size(viewer.window) == size, "the new size")
            yield size

    def test_every_tab_shows_all_that_is_in_it(self):
        with self.view(STEPS, "--technique", "slices_denoised") as viewer:
            for size in self.each_size(viewer):
                for tab, widget in self.TABS.items():
                    with self.subTest(size=size, tab=tab):
                        viewer.open_tab(tab, widget)
                        self.assertEqual(clipped(viewer), [])

    def test_long_values_have_room_in_their_fields(self):
        lamp = "--lamp=-1234.567,-1234.567,1234.567:radius=0.123456:cd=12345678:to=0,0,0"
        with self.view(STEPS, *self.LOOK, *FAR, lamp, "--set", "pcf.filter_taps=256", "--set", "sun.angle=0.0123",
                       rests=False) as viewer:
            viewer.open_tab("Scene", "eye")
            viewer.click("entry of lamp 0", lambda: viewer.has("lamp place"), "the lamp's properties")
            for size in self.each_size(viewer):
                with self.subTest(size=size):
                    for tab in ("Shadow", "Files", "Scene"):
                        viewer.open_tab(tab, self.TABS[tab])
                        self.assertEqual(clipped(viewer), [])
                    self.assertTrue(viewer.has("lamp place"))

    def check_sliders(self, viewer, expected):
        """The value of each slider stands beside it, within the panel; there are at least so many."""
        viewer.leave()
        viewer.follow()
        layout = viewer.layout()
        sliders = [name for name in layout if f"{name} value" in layout]
        self.assertGreaterEqual(len(sliders), expected)
        for name in sliders:
            left, top, right, bottom = layout[name]
            value = layout[f"{name} value"]
            self.assertGreater(right - left, 50, name)
            self.assertGreater(value[0], right, name)
            self.assertLess(max(top, value[1]), min(bottom, value[3]), name)
            reset = layout.get(f"{name} reset")
            end = reset[0] if reset else viewer.box("picture")[0] or self.desktop.client.size(viewer.window)[0]
            self.assertLess(value[2], end, name)

    def test_values_stand_beside_their_sliders(self):
        lamp = "--lamp=1,2,3:radius=0.123456:cd=12345678:to=0,0,0"
        with self.view(STEPS, *self.LOOK, lamp, "--set", "pcf.filter_taps=256", rests=False) as viewer:
            viewer.open_tab("Scene", "eye")
            viewer.click("entry of lamp 0", lambda: viewer.has("lamp place"), "the lamp's properties")
            for size in self.each_size(viewer):
                with self.subTest(size=size):
                    viewer.open_tab("Scene", "eye")
                    self.check_sliders(viewer, 5)
                    viewer.open_tab("Shadow", "search")
                    viewer.find_all("e")
                    self.check_sliders(viewer, 10)
                    self.assertEqual(clipped(viewer), [])

    def test_a_search_that_finds_every_parameter(self):
        with self.view(STEPS, *self.LOOK) as viewer:
            viewer.point_at("search")
            self.desktop.xdotool("click", LEFT)
            viewer.follow()
            viewer.type("e")
            viewer.wait_for(lambda: viewer.has("cascades.count"), "the parameters of closed groups")
            for size in self.each_size(viewer):
                with self.subTest(size=size):
                    self.assertEqual(clipped(viewer), [])

    def test_a_panel_that_is_too_low_for_its_contents_scrolls(self):
        with self.view(STEPS, *self.LOOK, size=(420, 600)) as viewer:
            viewer.open_tab("Inspect", "shown list")
            viewer.press("t", lambda: viewer.has("legend"), "the legend")
            for size in self.each_size(viewer, [(420, 300), (420, 220)]):
                self.assertEqual(clipped(viewer), [])

    def test_labels_stay_within_the_picture(self):
        with self.view(STEPS, *self.LOOK) as viewer:
            viewer.press("c", lambda: viewer.has("line"), "the line")
            viewer.open_tab("Compare", "b")
            viewer.choose("b", "slices_denoised")
            for size in self.each_size(viewer):
                with self.subTest(size=size):
                    self.assertEqual(clipped(viewer), [])
                    left, top, right, bottom = viewer.box("picture")
                    self.assertGreaterEqual(right - left, 240)
                    labels = [box for name, box in viewer.layout().items() if name.startswith("label ")]
                    self.assertEqual(len(labels), 2)
                    for box in labels:
                        self.assertTrue(left <= box[0] < box[2] <= right and top <= box[1] < box[3] <= bottom, box)

    def test_lists_and_questions(self):
        with self.view(STEPS, *self.LOOK) as viewer:
            for size in self.each_size(viewer):
                for key, widget in (("F1", "keys"), ("ctrl+o", "open up")):
                    with self.subTest(size=size, key=key):
                        viewer.press(key, lambda widget=widget: viewer.has(widget), widget)
                        self.assertEqual(clipped(viewer), [])
                        viewer.press("Escape", lambda widget=widget: not viewer.has(widget), f"no {widget}")
            viewer.click("tab Shadow", lambda: viewer.has("save preset"), "the tab")
            (self.folder / "preset.toml").write_text("technique = \"pcf\"\n")
            for size in self.each_size(viewer, [(420, 600), (1280, 720)]):  # the button is in sight
                with self.subTest(size=size):
                    viewer.click("save preset", lambda: viewer.has("keep preset"), "the question")
                    self.assertEqual(clipped(viewer), [])
                    viewer.click("keep preset", lambda: not viewer.has("keep preset"), "no question")

    def test_the_panel_is_below_the_picture_and_its_edge_is_dragged(self):
        with self.view(STEPS, *self.LOOK, size=(420, 600)) as viewer:
            picture, edge = viewer.box("picture"), viewer.box("panel edge")
            self.assertEqual((picture[0], picture[2]), (0, 420))
            self.assertLess(abs(picture[3] - viewer.middle("panel edge")[1]), 2)
            self.assertGreater(viewer.box("technique")[1], picture[3])
            x, y = viewer.middle("panel edge")
            self.desktop.xdotool("mousemove", "--window", viewer.window, x, y, "mousedown", LEFT)
            viewer.follow()
            viewer.move(x, y - 60)
            viewer.follow()
            self.desktop.xdotool("mouseup", LEFT)
            viewer.wait_for(lambda: abs(viewer.box("picture")[3] - (y - 60)) < 3, "a higher panel")
            self.assertNotEqual(viewer.box("panel edge"), edge)
            viewer.click("show panel", lambda: not viewer.has("technique"), "the panel to go")
            self.assertGreater(height(viewer.box("picture")), 500)
            viewer.click("show panel", lambda: viewer.has("technique"), "the panel to come back")


class Tooltips(TestCase):
    """Texts and coordinates that are longer than their fields have a tooltip; others have none."""

    FIELDS = {"Shadow": ["preset file"], "Files": ["picture file"],
              "Scene": ["scene file", "eye", "target", "lamp place", "lamp axis"]}

    def look_at_each(self, *arguments, entered="", check):
        """Calls check() with each field under the pointer, with the panel below the picture and beside it, in
        windows that are high enough for all of a tab. `entered`: typed into the files of presets and pictures."""
        with Desktop(1300, 1450) as desktop, \
                Viewer(desktop, *arguments, *NO_SMOOTH_EDGES, "--technique", "none", size=(1280, 1400), rests=False,
                       folder=self.folder) as viewer:
            viewer.open_tab("Scene", "eye")
            viewer.click("entry of lamp 0", lambda: viewer.has("lamp axis"), "the lamp's properties")
            for tab, fields in self.FIELDS.items():
                viewer.open_tab(tab, fields[0])
                if tab != "Scene":
                    viewer.point_at(fields[0])
                    desktop.xdotool("click", LEFT, "key", "ctrl+a")
                    viewer.type(entered)
                    viewer.tap("Return")
            for size in (420, 1400), (620, 1400), (1280, 1400):
                desktop.xdotool("windowsize", viewer.window, *size)
                viewer.wait_for(lambda size=size: desktop.client.size(viewer.window) == size, "the new size")
                for tab, fields in self.FIELDS.items():
                    viewer.open_tab(tab, fields[0])
                    for field in fields:
                        with self.subTest(size=size, field=field):
                            viewer.point_at(field)
                            check(viewer, field)

    def expect_one(self, viewer, field):
        if field == "lamp axis":  # of length 1, so that it has room everywhere
            self.expect_none(viewer, field)
        else:
            viewer.wait_for(lambda: viewer.has(f"all of {field}"), f"all of {field}")

    def expect_none(self, viewer, field):
        self.assertFalse(viewer.has(f"all of {field}"))

    def test_long_values_have_one(self):
        folder = self.folder / "a folder whose name is longer than any field of a narrow window has room for"
        folder.mkdir()
        self.look_at_each(shutil.copy(STEPS, folder), *FAR, "--lamp=-12345678,1,1:to=0,0,0", entered=f"{folder}/file.png",
                          check=self.expect_one)

    def test_short_values_have_none(self):
        shutil.copy(STEPS, self.folder / "a.glb")
        self.look_at_each("a.glb", "--eye=9,8,7", "--target=0,1,0", "--lamp=1,2,3:to=0,0,0", entered="a.png",
                          check=self.expect_none)


class Scale(TestCase):
    def test_twice_the_dots_take_twice_the_pixels(self):
        boxes = []
        for dpi in (96, 192):
            with Desktop(1400, 900, resources=f"Xft.dpi: {dpi}") as desktop, \
                    Viewer(desktop, STEPS, *SMALL_MAPS, *NO_SMOOTH_EDGES, size=(1280, 720)) as viewer:
                self.assertGreater(len(viewer.rest().colors()), 30)
                boxes.append({name: viewer.box(name) for name in ("technique", "search", "tab Scene", "reset all")})
        for name, box in boxes[0].items():
            with self.subTest(name=name):
                self.assertAlmostEqual(height(boxes[1][name]) / height(box), 2, delta=0.1)
                self.assertAlmostEqual(width(boxes[1][name]) / width(box), 2, delta=0.25)


if __name__ == "__main__":
    main()
