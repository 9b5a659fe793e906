"""penumbra view: bookmarks of the camera, by keys and by the menu, and the key that frames what casts shadows."""

import json
import math

from desktop import LEFT
from support import main
from window import STEPS, WindowTest


class Camera(WindowTest):
    EYE, TARGET = (0, 5, 12), (0, 1, 0)
    VIEW = ("--eye=0,5,12", "--target=0,1,0", "--fov=40")

    def setUp(self):
        super().setUp()
        self.scene = self.folder / "mine.glb"
        self.scene.write_bytes(STEPS.read_bytes())
        self.saved = self.folder / "mine.glb.view.json"

    def camera(self, viewer):
        return [word for word in viewer.copied() if word.split("=")[0] in ("--eye", "--target", "--fov")]

    def tap(self, viewer, *keys):
        for key in keys:
            viewer.tap(key)
            viewer.follow()

    def turn(self, viewer, on="picture"):
        """Turns the camera by a drag that starts in the middle of a widget, and returns the new one."""
        before, (x, y) = self.camera(viewer), viewer.middle(on)
        viewer.move(x, y)
        self.desktop.xdotool("mousedown", LEFT)
        for step in (10, 50, 90):
            viewer.follow()
            viewer.move(x + step, y)
        viewer.follow()
        self.desktop.xdotool("mouseup", LEFT)
        viewer.follow()
        self.assertNotEqual(self.camera(viewer), before)
        return self.camera(viewer)


class Bookmarks(Camera):
    def test_keys_store_them_and_go_back_and_both_are_undone(self):
        with self.view("mine.glb", *self.VIEW) as viewer:
            first = self.camera(viewer)
            self.tap(viewer, "ctrl+1")
            second = self.turn(viewer)
            self.tap(viewer, "ctrl+9", "1")
            self.assertEqual(self.camera(viewer), first)
            self.tap(viewer, "9")
            self.assertEqual(self.camera(viewer), second)
            self.tap(viewer, "5")  # is empty
            self.assertEqual(self.camera(viewer), second)
            self.tap(viewer, "ctrl+z")
            self.assertEqual(self.camera(viewer), first)
            self.tap(viewer, "ctrl+z")
            self.assertEqual(self.camera(viewer), second)
            self.tap(viewer, "ctrl+z")  # takes back that 9 was stored, and nothing else
            self.assertEqual(self.camera(viewer), second)
            self.tap(viewer, "1")
            self.tap(viewer, "9")
            self.assertEqual(self.camera(viewer), first)

    def test_the_menu_has_them_and_the_next_start_too(self):
        with self.view("mine.glb") as viewer:
            viewer.click("menu Camera", lambda: viewer.has("menu=Go to bookmark 9"), "the menu")
            viewer.click("menu Store bookmark", lambda: viewer.has("menu=Bookmark 4"), "the bookmarks")
            viewer.click("menu=Bookmark 4", lambda: not viewer.has("menu=Bookmark 4"), "the menu to close")
            viewer.follow()
            self.turn(viewer)
            viewer.tap("ctrl+s")
            viewer.wait_for(self.saved.exists, "the saved view")
        bookmarks = json.loads(self.saved.read_text())["bookmarks"]
        self.assertEqual(list(bookmarks), ["4"])
        with self.view("mine.glb") as viewer:
            self.assertNotEqual(self.camera(viewer), bookmarks["4"])
            viewer.click("menu Camera", lambda: viewer.has("menu=Go to bookmark 4"), "the menu")
            viewer.click("menu=Go to bookmark 4", lambda: not viewer.has("menu=Go to bookmark 4"), "the menu to close")
            viewer.follow()
            self.assertEqual(self.camera(viewer), bookmarks["4"])
            self.tap(viewer, "ctrl+2")
            viewer.tap("Escape")
            viewer.wait_for(lambda: viewer.has("closing=Save"), "the question")


class Travel(Camera):
    def test_a_key_that_was_pressed_with_ctrl_moves_nothing_once_ctrl_is_let_go(self):
        with self.view("mine.glb", *self.VIEW) as viewer:
            before = self.camera(viewer)
            self.desktop.xdotool("keydown", "ctrl", "keydown", "s")
            viewer.follow()
            self.desktop.xdotool("keyup", "ctrl")
            viewer.follow()
            self.desktop.xdotool("keyup", "s")
            viewer.follow()
            self.assertEqual(self.camera(viewer), before)
            self.desktop.xdotool("keydown", "s")
            viewer.follow()
            self.desktop.xdotool("keyup", "s")
            viewer.follow()
            self.assertNotEqual(self.camera(viewer), before)


class Messages(Camera):
    def test_the_mouse_reaches_the_picture_below_them_and_only_the_last_copy_is_told(self):
        with self.view("mine.glb", *self.VIEW) as viewer:
            def height():
                viewer.follow()
                _, top, _, bottom = viewer.box("messages")
                return bottom - top

            self.camera(viewer)
            one = height()
            self.turn(viewer, on="messages")
            self.assertLess(height(), 1.5 * one)


class Home(Camera):
    def test_it_shows_the_casters_without_the_ground(self):
        # The steps lie within 7 m of the middle; the ground reaches three times as far.
        with self.view("mine.glb", *self.VIEW) as viewer:
            before = viewer.rest()
            self.tap(viewer, "Home")
            eye, target = (tuple(map(float, word.split("=")[1].split(","))) for word in self.camera(viewer)[:2])
            self.assertLess(math.dist(target, (0, 2, 0)), 0.5)
            half = 7.5 * math.sqrt(1 + 1 / math.tan(math.radians(20)) ** 2 / (410 / 550) ** 2)
            self.assertLess(math.dist(eye, target), half)
            self.assertGreater(math.dist(eye, target), half * 0.7)
            self.assertNotEqual(viewer.rest(), before)


if __name__ == "__main__":
    main()
