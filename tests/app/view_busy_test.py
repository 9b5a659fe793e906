"""penumbra view answers the user while it draws a picture that takes long."""

from desktop import LEFT, RIGHT
from support import main
from window import STEPS, WindowTest

# Lamps with six maps each, and many taps: hundreds of passes, which take seconds in software.
LAMPS = [f"--lamp={x},3,{z}" for x in (-1.5, -0.5, 0.5, 1.5) for z in (-1, 1)][1:]
LAMP_MAPS = ("--set", "lamps.size=256")


class Busy(WindowTest):
    def begin(self, viewer):
        """Turns the sun, and waits until the finished picture is being drawn."""
        viewer.drag(*viewer.middle("picture"), RIGHT, lambda: not viewer.has("idle"), "another picture")
        self.wait_until_drawn(viewer)

    def wait_until_drawn(self, viewer):
        """Waits until the finished picture is being drawn: the layout says so once there is input."""
        x, y = viewer.middle("search")

        def is_begun():
            nonlocal x
            x += 1 if x % 2 == 0 else -1  # the pointer moves
            viewer.move(x, y)
            return viewer.has("drawing")

        viewer.wait_for(is_begun, "a picture in the works")

    def click(self, viewer, widget):
        self.desktop.xdotool("mousemove", "--window", viewer.window, *viewer.middle(widget), "click", LEFT)

    def test_a_click_on_a_panel_is_seen_before_the_picture_is_finished(self):
        # The first picture is none of those that take long.
        with self.view(STEPS, *LAMPS, *LAMP_MAPS, "--technique", "none", size=(1000, 700)) as viewer:
            first = viewer.rest()
            viewer.choose("technique", "brute_force")
            self.wait_until_drawn(viewer)
            viewer.wait_for(lambda: viewer.picture() != first, "a first picture of brute_force")
            motion = viewer.picture()
            for tab, widget in (("Scene", "scene file"), ("Files", "copy command"), ("Shadow", "technique")):
                self.click(viewer, f"tab {tab}")
                viewer.wait_for(lambda widget=widget: viewer.has(widget), f"the tab {tab}")
                self.assertTrue(viewer.has("drawing"), tab)
            self.assertEqual(viewer.picture(), motion)
            self.assertNotEqual(viewer.rest(), motion)

    def test_what_changes_the_picture_ends_it(self):
        # With several samples of each pixel, three lamps and a small picture take long enough.
        with self.view(STEPS, *LAMPS[::3], *LAMP_MAPS, "--technique", "brute_force", size=(640, 400),
                       edges=()) as viewer:
            first = viewer.rest()
            for _ in range(3):
                self.begin(viewer)
            viewer.tap("ctrl+z")
            viewer.tap("ctrl+z")
            viewer.tap("ctrl+z")
            viewer.wait_for(lambda: viewer.rest() == first, "the first picture")
            self.begin(viewer)
            viewer.tap("Escape")
            viewer.wait_for(lambda: viewer.has("closing=Discard"), "the question")
            self.assertFalse(viewer.has("idle"))
            self.click(viewer, "closing=Discard")
            self.assertEqual(viewer.exit_code(), 0)


if __name__ == "__main__":
    main()
