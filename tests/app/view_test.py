"""penumbra view in a real window: what the mouse and the keys do to the picture, and how it ends."""

import math
import os
import signal

from desktop import LEFT, MIDDLE, RIGHT, WHEEL_DOWN, WHEEL_UP
from support import main
from window import SMALL_MAPS, STEPS, WindowTest, read


class Picture(WindowTest):
    def test_a_technique_and_a_parameter_change_the_picture(self):
        with self.view(STEPS) as viewer:
            usual = viewer.rest()
            self.assertGreater(len(usual.colors()), 30)
            viewer.choose("technique", "none")
            none = viewer.changed(usual)
            self.assertGreater(none.differing(usual, by=16), 0.01)
            # No shadows: nothing is darker, but for the little that the automatic exposure takes back.
            self.assertTrue(all(light > dark - 8 for rows in zip(none.rows, usual.rows) for light, dark in zip(*rows)))
            viewer.choose("technique", "slices_denoised")
            self.assertEqual(viewer.changed(none), usual)
            viewer.find("sun.angle")
            viewer.fill_in("sun.angle", "8", lambda: viewer.has("sun.angle reset"), "another angle")
            wide = viewer.changed(usual)
            self.assertGreater(wide.differing(usual, by=16), 0.001)
            viewer.click("sun.angle reset", lambda: not viewer.has("sun.angle reset"), "the default")
            self.assertEqual(viewer.changed(wide), usual)

    def test_a_word_is_chosen_from_a_list(self):
        with self.view(STEPS, "--set", "sun.angle=8") as viewer:
            disc = viewer.rest()
            viewer.find("sun.shape")
            viewer.choose("sun.shape", "square")
            self.assertGreater(viewer.changed(disc).differing(disc), 0)

    def test_it_is_the_picture_that_render_writes(self):
        options = ("--technique", "pcf", "--sun", "40,35", "--set", "sun.angle=3")
        with self.view(STEPS, *options, edges=(), size=(640, 400)) as viewer:
            shown = viewer.rest()
            self.assertGreater(len(shown.colors()), 30)
            left, top, right, bottom = viewer.box("picture")
        self.succeed("render", STEPS, *options, *SMALL_MAPS, "--size", f"{right - left}x{bottom - top}", "-o",
                     self.folder / "written.png", "--sample-shadows", "--quiet")
        written = read(self.folder / "written.png")
        written = written.crop(0, written.height // 3, written.width, written.height * 3 // 4)
        self.assertEqual(written.differing(shown, by=1), 0)

    def test_at_rest_each_sample_has_shadows_of_its_own(self):
        # Penumbrae of some pixels, and edges of none.
        for options in (("--technique", "pcss", "--set", "sun.angle=3"), ("--technique", "hard")):
            with self.subTest(options), self.view(STEPS, *options, edges=(), size=(640, 400)) as viewer:
                shown = viewer.rest()
                left, top, right, bottom = viewer.box("picture")
                written = {}
                for name, shadows in (("own", ["--sample-shadows"]), ("first", [])):
                    self.succeed("render", STEPS, *options, *SMALL_MAPS, "--samples", 4, *shadows, "--size",
                                 f"{right - left}x{bottom - top}", "-o", self.folder / f"{name}.png", "--quiet")
                    whole = read(self.folder / f"{name}.png")
                    written[name] = whole.crop(0, whole.height // 3, whole.width, whole.height * 3 // 4)
                self.assertEqual(written["own"].differing(shown, by=1), 0)
                self.assertGreater(written["first"].differing(shown, by=4), 0.0005, "the shadows of the first samples")


class Hand(WindowTest):
    EYE, TARGET, SUN = (0, 5, 12), (0, 1, 0), (20, 50)  # metres, along -Z; degrees

    def setUp(self):
        super().setUp()
        options = {"eye": self.EYE, "target": self.TARGET, "sun": self.SUN}
        self.viewer = self.enterContext(
            self.view(STEPS, *(f"--{name}={','.join(map(str, values))}" for name, values in options.items())))
        self.viewer.open_tab("Scene", "eye")

    def place(self):
        """Eye, target and sun, of the command line that is copied."""
        options = dict(word.split("=", 1) for word in self.viewer.copied() if "=" in word)
        return [tuple(map(float, options[f"--{name}"].split(","))) for name in ("eye", "target", "sun")]

    def dragged(self, button, number):
        """The place after a drag to the right and downwards, which changes a number of the panel."""
        before, resting = self.viewer.rest(), self.viewer.seen(number)
        self.viewer.drag(*self.viewer.middle("picture"), button, lambda: self.viewer.seen(number) != resting,
                         "another number")
        self.assertGreater(self.viewer.changed(before).differing(before, by=16), 0.005)
        return self.place()

    def test_the_left_button_turns_the_camera_about_the_scene(self):
        eye, target, sun = self.dragged(LEFT, "eye")
        self.assertEqual((target, sun), (self.TARGET, self.SUN))
        self.assertAlmostEqual(math.dist(eye, target), math.dist(self.EYE, self.TARGET), places=3)
        self.assertLess(eye[0], self.EYE[0])  # the scene in front follows the pointer
        self.assertGreater(eye[1], self.EYE[1])

    def test_the_middle_button_shifts_the_camera(self):
        eye, target, sun = self.dragged(MIDDLE, "eye")
        self.assertEqual(sun, self.SUN)
        shift = [now - then for now, then in zip(eye, self.EYE)]
        for now, then, by in zip(target, self.TARGET, shift):
            self.assertAlmostEqual(now - then, by, places=4)
        self.assertLess(shift[0], 0)  # the scene follows the pointer
        self.assertGreater(shift[1], 0)

    def test_the_right_button_moves_the_sun(self):
        eye, target, sun = self.dragged(RIGHT, "azimuth")
        self.assertEqual((eye, target), (self.EYE, self.TARGET))
        self.assertGreater(sun[0], self.SUN[0])
        self.assertLess(sun[1], self.SUN[1])

    def held(self, *places):
        """Presses the left button in the picture, moves to each place from there with a frame at each, and releases."""
        x, y = self.viewer.middle("picture")
        self.desktop.xdotool("mousemove", "--window", self.viewer.window, x, y, "mousedown", LEFT)
        for dx, dy in places:
            self.viewer.follow()
            self.viewer.move(x + dx, y + dy)
        self.viewer.follow()
        self.desktop.xdotool("mouseup", LEFT)
        self.viewer.follow()

    def test_a_click_moves_nothing(self):
        before = self.viewer.rest()
        self.held((2, 1), (-1, 3), (3, 0))
        self.assertEqual(self.place(), [self.EYE, self.TARGET, self.SUN])
        self.viewer.click("tab Files", lambda: self.viewer.has("write picture"), "the tab Files")
        self.held((-2, -2))
        self.assertEqual(self.place(), [self.EYE, self.TARGET, self.SUN])
        self.viewer.wait_for(lambda: self.viewer.rest() == before, "the picture as it was")

    def test_a_drag_begins_without_a_jump(self):
        self.held((60, 0), (100, 0))
        eye, target, sun = self.place()
        self.assertEqual((target, sun), (self.TARGET, self.SUN))
        turned = math.atan2(eye[0] - target[0], eye[2] - target[2])
        self.assertAlmostEqual(turned, -40 * 0.006, places=4)

    def test_the_wheel_goes_nearer_and_back(self):
        start, eye = self.viewer.rest(), self.viewer.seen("eye")
        self.viewer.wheel(WHEEL_UP, lambda: self.viewer.seen("eye") != eye, "a nearer eye")
        self.assertGreater(self.viewer.changed(start).differing(start, by=16), 0.005)
        near, *others = self.place()
        self.assertEqual(others, [self.TARGET, self.SUN])
        self.assertLess(math.dist(near, self.TARGET), math.dist(self.EYE, self.TARGET))
        self.viewer.wheel(WHEEL_DOWN, lambda: self.viewer.seen("eye") == eye, "the eye as it was")


class Keys(WindowTest):
    def test_tab_hides_the_panel(self):
        with self.view(STEPS) as viewer:
            viewer.press("Tab", lambda: viewer.box("picture")[0] == 0, "the picture alone")
            self.assertFalse(viewer.has("technique"))
            viewer.press("Tab", lambda: viewer.has("technique"), "the panel")
            self.assertGreater(viewer.box("picture")[0], 0)

    def test_a_key_that_is_tapped_counts_once(self):
        with self.view(STEPS) as viewer:
            for hidden in (True, False, True, False):
                viewer.tap("Tab")
                viewer.follow()
                self.assertEqual(viewer.has("technique"), not hidden)

    def test_f1_shows_the_keys(self):
        with self.view(STEPS) as viewer:
            before = viewer.rest()
            viewer.press("F1", lambda: viewer.has("keys"), "the list of keys")
            viewer.changed(before)
            viewer.press("F1", lambda: not viewer.has("keys"), "no list")
            self.assertEqual(viewer.rest(), before)

    def test_c_compares_and_x_takes_turns(self):
        with self.view(STEPS) as viewer:
            a = viewer.rest()
            viewer.press("c", lambda: viewer.has("line"), "the line")
            line = viewer.changed(a)
            left, _, right, _ = viewer.box("line")
            at = (left + right) // 2 - viewer.box("picture")[0]
            half = line.width // 2 - 4
            self.assertEqual(line.crop(0, 0, half, line.height), a.crop(0, 0, half, a.height))
            # B begins as the truth.
            self.assertGreater(line.crop(half + 8, 0, line.width, line.height).differing(
                a.crop(half + 8, 0, a.width, a.height), by=8), 0.001)
            self.assertGreater(line.crop(at - 2, 0, at + 3, line.height).differing(
                a.crop(at - 2, 0, at + 3, a.height)), 0.1)
            viewer.open_tab("Compare", "b")
            viewer.choose("b", "none")
            both = viewer.changed(line)
            self.assertEqual(both.crop(0, 0, half, both.height), a.crop(0, 0, half, a.height))
            viewer.press("x", lambda: not viewer.has("line"), "A alone")
            self.assertEqual(viewer.changed(both), a)
            viewer.press("x", lambda: viewer.picture() != a, "B alone")
            b = viewer.changed(a)
            self.assertEqual(both.crop(half + 8, 0, both.width, both.height), b.crop(half + 8, 0, b.width, b.height))

    def test_the_mouse_drags_the_line(self):
        with self.view(STEPS, "--technique", "none") as viewer:
            viewer.press("c", lambda: viewer.has("line"), "the line")
            viewer.rest()
            before = viewer.box("line")
            viewer.open_tab("Scene", "eye")
            eye = viewer.seen("eye")
            viewer.drag(*viewer.middle("line"), LEFT, lambda: viewer.box("line")[0] > before[0] + 20,
                        "the line to move")
            viewer.rest()
            self.assertEqual(viewer.seen("eye"), eye)


class End(WindowTest):
    def test_escape_and_the_windows_own_button(self):
        for key in ("Escape", "alt+F4"):
            with self.subTest(key=key), self.view(STEPS) as viewer:
                self.desktop.xdotool("key", key)
                self.assertEqual(viewer.exit_code(), 0)

    def test_escape_closes_a_list_first(self):
        with self.view(STEPS) as viewer:
            viewer.press("F1", lambda: viewer.has("keys"), "the list of keys")
            viewer.press("Escape", lambda: not viewer.has("keys"), "no list")
            viewer.click("technique", lambda: viewer.has("technique=pcf"), "the techniques")
            viewer.press("Escape", lambda: not viewer.has("technique=pcf"), "no techniques")
            viewer.rest()

    def test_signals(self):
        for number in (signal.SIGTERM, signal.SIGINT):
            with self.subTest(number=number), self.view(STEPS) as viewer:
                self.assertEqual(viewer.signal(number), 128 + number)

    def test_there_is_no_display(self):
        environment = {key: value for key, value in os.environ.items() if "DISPLAY" not in key}
        line = self.refuse("view", STEPS, env=environment)
        self.assertIn("penumbra render", line)
        self.assertIn("penumbra watch", line)
        self.assertIn(":31999", self.refuse("view", STEPS, env={**environment, "DISPLAY": ":31999"}))

    def test_the_displays_opengl_is_too_old(self):
        line = self.refuse("view", STEPS, env={**self.desktop.environment(), "MESA_GL_VERSION_OVERRIDE": "3.3"})
        self.assertIn("window: no window with an OpenGL 4.5 context (", line)


if __name__ == "__main__":
    main()
