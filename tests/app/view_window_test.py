"""penumbra view and its window: sizes, minimising, screens with twice the dots."""

import signal

from desktop import Desktop
from support import TestCase, main
from viewer import Viewer
from window import STEPS, WindowTest


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
            for _ in range(150):
                for size in ((1, 1), (1200, 300)):
                    self.desktop.xdotool("windowsize", viewer.window, *size)
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


class Scale(TestCase):
    def test_twice_the_dots_take_twice_the_pixels(self):
        boxes = []
        for dpi in (96, 192):
            with Desktop(1400, 900, resources=f"Xft.dpi: {dpi}") as desktop, \
                    Viewer(desktop, STEPS, size=(1280, 720)) as viewer:
                self.assertGreater(len(viewer.rest().colors()), 30)
                boxes.append({name: viewer.box(name) for name in ("technique", "search", "tab Scene", "reset all")})
        for name, box in boxes[0].items():
            with self.subTest(name=name):
                self.assertAlmostEqual(height(boxes[1][name]) / height(box), 2, delta=0.1)
                self.assertAlmostEqual(width(boxes[1][name]) / width(box), 2, delta=0.25)


if __name__ == "__main__":
    main()
