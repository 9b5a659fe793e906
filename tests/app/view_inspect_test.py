"""penumbra view: AOVs and textures to look at, A against B, files from a list, an animation that stands still."""

import math
import subprocess

import pictures
from desktop import LEFT, WHEEL_UP
from support import PROGRAM, main
from window import STEPS, WindowTest, read

MOVING, POSTS = pictures.scene("moving"), pictures.scene("posts")
TINY_MAPS = ("--set", "cascades.size=128")
# A finished picture takes 32 frames, so each is cheap.
THESIS = ("--technique", "thesis", "--set", "sun.angle=4", "--set", "pcss.blocker_taps=6", "--set", "pcss.filter_taps=6",
          "--set", "pcss.disocclusion_taps=6")
NARROW = {"size": (640, 400), "maps": TINY_MAPS}
LIGHT = "target shadow 1/view 0/light 0/"


def is_grey(picture):
    return all(red == green == blue for red, green, blue in picture.colors())


class Inspect(WindowTest):
    def test_steps_of_the_mask_are_looked_at_part_by_part(self):
        with self.view(STEPS, *THESIS, **NARROW) as viewer:
            colored = viewer.rest()
            self.assertFalse(is_grey(colored))
            viewer.open_tab("Inspect", "show=picture")
            viewer.look_at(f"{LIGHT}denoisers/history_and_filters/history surfaces/0")
            for part in ("green", "red"):  # they are no packed texels, though they have the same format
                viewer.choose("part", part)
            raw = viewer.look_at(f"{LIGHT}denoisers/history_and_filters/texels")
            self.assertTrue(is_grey(raw))
            self.assertGreater(len(raw.colors()), 30)
            viewer.choose("part", "mean blocker distance")
            distance = viewer.changed(raw)
            self.assertFalse(is_grey(distance))
            self.assertGreater(len(distance.colors()), 30)
            viewer.choose("part", "visibility")
            self.assertEqual(viewer.changed(distance), raw)
            mask = viewer.look_at("target shadow 1/view 0/mask")
            self.assertTrue(is_grey(mask))
            self.assertGreater(mask.differing(raw), 0)  # the filters' work

    def test_noise_is_shown_texel_by_texel(self):
        with self.view(STEPS, *THESIS, **NARROW) as viewer:
            viewer.open_tab("Inspect", "show=picture")
            noise = viewer.look_at("target shadow 1/noise/blue")
            self.assertTrue(is_grey(noise))
            rows = [bytes(row) for row in noise.rows]
            left, top, right, bottom = viewer.box("picture")
            self.assertLessEqual(len(set(rows)), 64)
            self.assertGreater(len(set(rows)), 20)
            self.assertGreater((right - left) * (bottom - top), 64 * 64)


    def texel(self, viewer):
        """Coordinates, size and value that the legend has for the cursor."""
        def text():
            viewer.follow()
            return next((name.removeprefix("texel=") for name in viewer.layout() if name.startswith("texel=")), None)

        place, value = viewer.wait_for(text, "a value").split(":")
        at, size = place.split(" of ")
        return tuple(map(int, at.split(", "))), tuple(map(int, size.split(" × "))), value.strip()

    def test_a_texture_fits_and_tells_its_own_texels(self):
        with self.view(STEPS, *THESIS, size=(900, 400), maps=TINY_MAPS) as viewer:
            viewer.open_tab("Inspect", "show=picture")
            self.assertTrue(viewer.has("point at the picture"))
            viewer.look_at("target shadow 1/noise/blue")
            self.assertTrue(viewer.has("values of a texture"))  # in the legend: the picture is not there to point at
            self.assertFalse(viewer.has("point at the picture"))
            left, top, right, bottom = viewer.box("picture")
            viewer.rest()
            whole = viewer.seen("picture")
            side = min(right - left, bottom - top)  # of the square that the tile is fitted to
            x0, y0 = left + (right - left - side) / 2, top + (bottom - top - side) / 2
            bar = whole.crop(0, whole.height // 2, int(x0 - left) - 2, whole.height // 2 + 40)
            self.assertEqual(len(bar.colors()), 1)
            for x, y in ((0, 0), (5, 17), (40, 30), (63, 10)):
                with self.subTest(x=x, y=y):
                    place = int(x0 + (x + 0.5) * side / 64), int(y0 + (63 - y + 0.5) * side / 64)
                    viewer.move(*place)
                    viewer.wait_for(lambda at=(x, y): self.texel(viewer)[0] == at, f"texel {x}, {y}")
                    _, size, value = self.texel(viewer)
                    self.assertEqual(size, (64, 64))
                    column, row = place[0] - left, place[1] - top
                    grey = whole.rows[row][3 * column]
                    self.assertAlmostEqual(float(value) * 255, grey, delta=0.6)
            self.desktop.xdotool("keydown", "ctrl", "click", WHEEL_UP, "click", WHEEL_UP, "keyup", "ctrl")
            viewer.leave()
            viewer.wait_for(lambda: viewer.seen("picture") != whole, "a magnified texture")
            viewer.press("0", lambda: True, "the key")
            viewer.leave()
            viewer.wait_for(lambda: viewer.seen("picture") == whole, "the whole texture")


class Compare(WindowTest):
    def test_rays_that_are_traced_before_their_frame_ends_are_shown(self):
        # Few rays of few pixels, and triangles that take long to draw again for smooth edges.
        look = (pictures.scene("courtyard"), "--set", "truth.samples=8")
        with self.view(*look, "--technique", "none", size=(640, 300), edges=()) as viewer:
            viewer.open_tab("Compare", "compare")
            viewer.click("compare", lambda: viewer.has("b"), "the choice of B")
            viewer.wait_for(lambda: viewer.has("distance"), "the figures")
            viewer.click("compare=B", lambda: not viewer.has("line"), "B alone")
            shown = viewer.rest()
            left, top, right, bottom = viewer.box("picture")
        self.succeed("render", *look, "--technique", "truth", "--size", f"{right - left}x{bottom - top}", "-o",
                     self.folder / "written.png", "--quiet")
        written = read(self.folder / "written.png")
        part = written.crop(0, written.height // 3, written.width, written.height * 3 // 4)
        self.assertEqual(part.differing(shown, by=1), 0)

    def test_two_truths_are_not_traced_against_each_other(self):
        small = {"size": (640, 300)}
        with self.view(STEPS, "--technique", "truth", "--set", "truth.samples=8", **small) as viewer:
            truth = viewer.rest()
            self.assertGreater(len(truth.colors()), 8)  # lit, dark, and between
            viewer.open_tab("Compare", "compare")
            viewer.click("compare", lambda: viewer.has("b"), "the choice of B")
            both = viewer.rest()
            self.assertTrue(viewer.has("label B: truth (not drawn yet)"))
            viewer.choose("b", "none")
            self.assertGreater(viewer.changed(both).differing(both, by=16), 0.001)


    def test_b_begins_as_the_truth_that_is_traced_at_rest_and_measured(self):
        with self.view(STEPS, *THESIS, "--set", "truth.samples=8", **NARROW) as viewer:
            viewer.open_tab("Compare", "compare")
            viewer.click("compare", lambda: viewer.has("b"), "the choice of B")
            viewer.wait_for(lambda: viewer.has("distance"), "the figures")
            wiped = viewer.rest()
            viewer.click("compare=B", lambda: not viewer.has("line"), "B alone")
            truth = viewer.changed(wiped)
            viewer.click("compare=A", lambda: True, "A alone")
            self.assertGreater(viewer.changed(truth).differing(truth, by=8), 0.001)
            figures = viewer.seen("distance")
            viewer.drag(*viewer.middle("picture"), LEFT, lambda: not viewer.has("distance"), "the figures to go")
            viewer.wait_for(lambda: viewer.has("distance"), "new figures")
            viewer.rest()
            self.assertGreater(viewer.seen("distance").differing(figures), 0)


class Search(WindowTest):
    def test_it_opens_the_groups_that_it_finds_and_leaves_them_as_they_were(self):
        with self.view(STEPS) as viewer:
            closed = "cascades.count"
            viewer.wait_for(lambda: viewer.has("group cascades"), "the groups")
            self.assertFalse(viewer.has(closed))
            viewer.find(closed)
            self.desktop.xdotool("key", "ctrl+a")
            viewer.type("no such thing")
            viewer.wait_for(lambda: viewer.has("nothing found"), "the word that nothing was found")
            self.desktop.xdotool("key", "ctrl+a", "BackSpace")
            viewer.wait_for(lambda: viewer.has("group cascades") and not viewer.has("nothing found"), "the groups again")
            self.assertFalse(viewer.has(closed))

    def test_small_values_of_a_wide_range_have_room_on_their_slider(self):
        with self.view(STEPS, "--sun-angle", "5", size=(900, 500)) as viewer:
            viewer.find("sun.angle")
            resting = viewer.rest()
            left, top, right, bottom = viewer.box("sun.angle")
            x = left + (right - left) * 3 // 4
            viewer.move(x, (top + bottom) // 2)
            self.desktop.xdotool("click", LEFT)
            viewer.changed(resting)
            command = viewer.copied()
            angle = next(float(word.split("=")[2]) for word in command if word.startswith("--set=sun.angle="))
        # From 0 to 20°, of which Dear ImGui takes 0 for 0.001. The grab and the gaps at its ends take 14 pixels.
        share = (x - left - 7) / (right - left - 14)
        self.assertAlmostEqual(math.log(angle), math.log(0.001) + share * math.log(20 / 0.001), delta=0.15)


class Status(WindowTest):
    def test_it_says_that_a_history_begins_anew(self):
        for size in ((700, 300), (420, 440)):  # small, since each picture is the last of 32 frames
            with self.subTest(size=size), self.view(STEPS, *THESIS, size=size, maps=TINY_MAPS) as viewer:
                self.assertFalse(viewer.has("history reset"))
                viewer.drag(*viewer.middle("picture"), LEFT, lambda: viewer.has("history reset"), "the word for a camera")
                viewer.rest()
                self.assertFalse(viewer.has("history reset"))
                viewer.find("sun.angle")
                viewer.fill_in("sun.angle", "7", lambda: viewer.has("history reset"), "the word for a parameter")
                viewer.rest()
                self.assertFalse(viewer.has("history reset"))

    def test_a_technique_without_a_history_has_none_to_reset(self):
        with self.view(STEPS, "--technique", "pcf") as viewer:
            viewer.drag(*viewer.middle("picture"), LEFT, lambda: not viewer.has("idle"), "another picture")
            self.assertFalse(viewer.has("history reset"))
            viewer.rest()


class Tint(WindowTest):
    def test_t_mixes_the_cascades_into_the_picture_and_stops(self):
        with self.view(STEPS) as viewer:
            lit = viewer.rest()
            viewer.press("t", lambda: viewer.has("legend"), "the legend")
            tinted = viewer.changed(lit)
            viewer.open_tab("Inspect", "over")
            viewer.click("over", lambda: viewer.picture() != tinted, "the cascades alone")
            alone = viewer.changed(tinted)
            left, _, right, _ = viewer.box("legend")
            width = left - viewer.box("picture")[0]
            for rows in zip(*(each.crop(0, 0, width, each.height).rows for each in (lit, alone, tinted))):
                for light, label, mixed in zip(*rows):
                    self.assertLess(abs(0.55 * light + 0.45 * label - mixed), 2)
            viewer.press("t", lambda: viewer.picture() != alone, "the tint")
            self.assertEqual(viewer.rest(), tinted)
            viewer.press("t", lambda: not viewer.has("legend"), "no legend")
            self.assertEqual(viewer.rest(), lit)

    def test_the_legend_lists_the_cascades_that_were_drawn(self):
        # Maps fitted to a view are fewer and larger than the parameters say, where that makes their texels finer.
        for fit, drawn in ("stable", 4), ("visible", 2):
            with self.subTest(fit=fit), self.view(STEPS, "--set", f"cascades.fit={fit}") as viewer:
                viewer.rest()
                viewer.press("t", lambda: viewer.has("legend"), "the legend")
                viewer.wait_for(lambda: viewer.has(f"label={drawn - 1}"), "the last cascade")
                self.assertFalse(viewer.has(f"label={drawn}"))


class Lock(WindowTest):
    def test_locked_values_stay_while_the_mouse_moves(self):
        with self.view(STEPS, size=(1000, 700)) as viewer:
            viewer.open_tab("Inspect", "show=picture")
            left, top, right, bottom = viewer.box("picture")

            def at(x, y):
                """The values in the panel with the pointer at a place of the picture, 0 to 1."""
                viewer.move(left + int(x * (right - left)), top + int(y * (bottom - top)))
                viewer.follow()
                return viewer.seen("probe values")

            low = at(0.5, 0.8)
            self.assertNotEqual(at(0.5, 0.3), low)
            self.assertEqual(at(0.5, 0.8), low)
            viewer.press("l", lambda: viewer.has("locked pixel"), "the lock")
            x, y = viewer.middle("locked pixel")
            self.assertLess(abs(x - left - 0.5 * (right - left)) + abs(y - top - 0.8 * (bottom - top)), 4)
            self.assertEqual(at(0.5, 0.3), low)
            self.desktop.xdotool("mousemove", "--window", viewer.window, *viewer.middle("lock"), "click", LEFT)
            viewer.wait_for(lambda: not viewer.has("locked pixel"), "no lock")
            self.assertNotEqual(at(0.5, 0.3), low)


class Preset(WindowTest):
    def test_a_value_is_marked_where_it_differs_from_the_preset_and_leads_back_to_that(self):
        with self.view(STEPS, "--technique", "slices_denoised", size=(640, 400)) as viewer:
            viewer.find("slices.azimuths")
            self.assertFalse(viewer.has("slices.azimuths reset"), "6 is the preset's own value")
            for text in ("9", "12"):
                viewer.fill_in("slices.azimuths", text, lambda: viewer.has("slices.azimuths reset"), "another value")
            self.assertIn("--set=slices.azimuths=12", viewer.copied())
            viewer.click("slices.azimuths reset", lambda: not viewer.has("slices.azimuths reset"), "the preset's value")
            command = viewer.copied()
        self.assertIn("--technique=slices_denoised", command)
        self.assertFalse([word for word in command if word.startswith("--set=slices")])

    def test_all_values_are_led_back_to_those_of_the_preset(self):
        with self.view(STEPS, *THESIS, size=(640, 400), maps=()) as viewer:
            self.assertGreater(sum(word.startswith("--set=") for word in viewer.copied()), 2)
            viewer.click("reset all", lambda: True, "the preset's values")
            viewer.follow()
            command = viewer.copied()
        self.assertIn("--technique=thesis", command)
        self.assertFalse([word for word in command if word.startswith("--set=")])

    def test_a_tooltip_leaves_the_value_and_what_resets_it_readable(self):
        with self.view(STEPS, "--sun-angle", "5", size=(900, 500)) as viewer:
            for number, text in enumerate(("sun.angle", "cascades.count", "sun")):
                viewer.find_all(text)
                widget = "sun.angle" if text == "sun" else text
                with self.subTest(number=number, widget=widget):
                    viewer.point_at(widget)
                    viewer.wait_for(lambda: viewer.has("tooltip"), "the tooltip")
                    viewer.follow()
                    left, top, right, bottom = viewer.box("tooltip")
                    _, low, _, high = viewer.box(widget)
                    self.assertTrue(top >= high or bottom <= low, (top, bottom, low, high))
                    self.assertTrue(left >= 0 and top >= 0 and right <= 900 and bottom <= 500, (left, top, right, bottom))

    def test_one_that_is_saved_draws_the_same_picture_by_render(self):
        preset = self.folder / "preset.toml"
        with self.view(STEPS, "--technique", "pcf", "--set", "sun.angle=6", size=(640, 400), edges=()) as viewer:
            viewer.find("pcf.filter_taps")
            viewer.fill_in("pcf.filter_taps", "7", lambda: viewer.has("pcf.filter_taps reset"), "other taps")
            shown = viewer.rest()
            viewer.click("save preset", preset.exists, "the preset")
            left, top, right, bottom = viewer.box("picture")
        self.assertIn("7", preset.read_text())
        self.succeed("render", STEPS, "--preset", preset, "--size", f"{right - left}x{bottom - top}", "-o",
                     self.folder / "written.png", "--sample-shadows", "--quiet")
        written = read(self.folder / "written.png")
        part = written.crop(0, written.height // 3, written.width, written.height * 3 // 4)
        self.assertEqual(part.differing(shown, by=1), 0)

    def test_one_that_is_there_is_overwritten_only_after_a_question(self):
        preset = self.folder / "preset.toml"
        first = 'technique = "pcf"\n'
        preset.write_text(first)
        with self.view(STEPS, "--technique", "pcss", size=(640, 400)) as viewer:
            for answer in (lambda gone: viewer.click("keep preset", gone, "no question"),
                           lambda gone: viewer.press("Escape", gone, "no question")):
                viewer.click("save preset", lambda: viewer.has("overwrite preset"), "the question")
                answer(lambda: not viewer.has("overwrite preset"))
                viewer.follow()
                self.assertEqual(preset.read_text(), first)
            viewer.click("save preset", lambda: viewer.has("overwrite preset"), "the question")
            viewer.click("overwrite preset", lambda: preset.read_text() != first, "another preset")
        self.assertIn("pcss", preset.read_text())

    def test_it_takes_the_place_of_no_other_file(self):
        settings = b'[package]\nname = "another program\'s"\n'
        for name, content in (("mine.glb", STEPS.read_bytes()), ("package.toml", settings)):
            (self.folder / name).write_bytes(content)
        for name in ("mine.glb", "package.toml"):
            with self.subTest(name=name), self.view("mine.glb") as viewer:
                viewer.point_at("preset file")
                self.desktop.xdotool("click", LEFT)
                viewer.follow()
                self.desktop.xdotool("key", "ctrl+a", "type", name)
                viewer.tap("Return")
                viewer.follow()
                viewer.click("save preset", lambda viewer=viewer: viewer.has("messages"), "a message")
        self.assertEqual((self.folder / "mine.glb").read_bytes(), STEPS.read_bytes())
        self.assertEqual((self.folder / "package.toml").read_bytes(), settings)


class Click(WindowTest):
    def test_it_hits_where_it_was_though_the_pointer_is_gone_by_then(self):
        with self.view(STEPS) as viewer:
            viewer.open_tab("Compare", "compare")
            viewer.point_at("compare")
            self.desktop.xdotool("click", LEFT, "mousemove", *self.desktop.corner)
            viewer.wait_for(lambda: viewer.has("b"), "the choice of B")


    def test_it_hits_where_the_pointer_was_not_seen_before(self):
        with self.view(STEPS) as viewer:
            viewer.leave()
            viewer.follow()
            self.desktop.xdotool("mousemove", "--window", viewer.window, *viewer.middle("tab Compare"), "click", LEFT)
            viewer.wait_for(lambda: viewer.has("compare"), "the tab")


class Key(WindowTest):
    def test_one_that_goes_up_and_down_again_within_a_frame_is_pressed_twice(self):
        with self.view(STEPS) as viewer:
            self.assertTrue(viewer.has("technique"))
            self.desktop.xdotool("keydown", "Tab")
            viewer.wait_for(lambda: not viewer.has("technique"), "the panel to go")
            self.desktop.xdotool("keyup", "Tab", "keydown", "Tab", "keyup", "Tab")
            viewer.wait_for(lambda: viewer.has("technique"), "the panel to come back")


    def test_a_name_that_is_typed_quickly_comes_as_it_was_typed(self):
        (self.folder / "hatch.glb").write_bytes(POSTS.read_bytes())
        wanted = self.picture_of(POSTS)
        with self.view(STEPS) as viewer:
            before = viewer.rest()
            viewer.open_tab("Scene", "scene file")
            viewer.point_at("scene file")
            self.desktop.xdotool("click", LEFT)
            viewer.follow()
            # Each letter of it would be a shortcut.
            self.desktop.xdotool("key", "ctrl+a", "type", "--delay", "1", f"{self.folder}/hx")
            self.desktop.xdotool("key", "BackSpace", "type", "--delay", "1", "atch.glb")
            self.desktop.xdotool("key", "Return")
            self.assertEqual(viewer.changed(before), wanted)
            self.assertTrue(viewer.has("scene file"))


class Open(WindowTest):
    def test_a_scene_is_chosen_from_a_list(self):
        (self.folder / "inner").mkdir()
        for name, scene in (("a.glb", STEPS), ("inner/b.glb", POSTS)):
            (self.folder / name).write_bytes(scene.read_bytes())
        wanted = self.picture_of(POSTS)
        with self.view("a.glb") as viewer:
            before = viewer.rest()
            viewer.press("ctrl+o", lambda: viewer.has("open=inner/"), "the list of files")
            self.assertTrue(viewer.has("open=a.glb"))
            viewer.click("open=inner/", lambda: viewer.has("open=b.glb"), "the inner folder")
            self.assertFalse(viewer.has("open=a.glb"))
            viewer.click("open=b.glb", lambda: not viewer.has("open=b.glb"), "the list to close")
            self.assertEqual(viewer.changed(before), wanted)

    def test_escape_closes_the_list_and_not_the_window(self):
        with self.view(STEPS) as viewer:
            before = viewer.rest()
            viewer.press("ctrl+o", lambda: viewer.has("open up"), "the list of files")
            viewer.press("Escape", lambda: not viewer.has("open up"), "the list to close")
            self.assertEqual(viewer.rest(), before)


class Animation(WindowTest):
    def test_a_moment_that_was_stepped_to_is_the_copied_commands(self):
        with self.view(MOVING, *THESIS, size=(640, 680), maps=TINY_MAPS) as viewer:
            start = viewer.rest()
            viewer.open_tab("Scene", "step")
            for _ in range(3):
                before = viewer.seen("frame value")
                viewer.click("step", lambda before=before: viewer.seen("frame value") != before, "the next frame")
            shown = viewer.changed(start)
            command = viewer.copied()
            self.assertIn("--warmup-still", command)
            viewer.press("F12", lambda: viewer.has("messages") and (self.folder / "penumbra.png").exists(), "the picture")
            self.assertEqual([path.name for path in self.folder.glob("*.png")], ["penumbra.png"])
            subprocess.run([PROGRAM, *command[1:]], cwd=self.folder, check=True, capture_output=True)
        written = read(next(self.folder.glob("*.png")))
        part = written.crop(0, written.height // 3, written.width, written.height * 3 // 4)
        self.assertEqual(part.differing(shown, by=1), 0)


if __name__ == "__main__":
    main()
