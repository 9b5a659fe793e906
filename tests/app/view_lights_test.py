"""The viewer's lights: those of the file, and lamps that the user adds and drags."""

from desktop import LEFT
from pictures import scene
from support import main
from window import STEPS, WindowTest


class Lights(WindowTest):
    def lamps(self, viewer):
        """The places of the lamps in the command line that is copied."""
        words = [word.split("=", 1)[1] for word in viewer.copied() if word.startswith("--lamp=")]
        return [tuple(map(float, word.split(":")[0].split(","))) for word in words]

    def test_a_lamp_is_added_dragged_and_removed(self):
        with self.view(STEPS, "--sun", "20,50") as viewer:
            viewer.open_tab("Scene", "eye")
            dark = viewer.rest()
            viewer.click("add lamp", lambda: viewer.has("ring=0"), "its ring")
            lit = viewer.changed(dark)
            self.assertGreater(lit.differing(dark, by=16), 0.005)
            (before,) = self.lamps(viewer)
            box = viewer.box("ring=0")
            viewer.drag(*viewer.middle("ring=0"), LEFT, lambda: viewer.box("ring=0") != box, "the ring elsewhere")
            moved = viewer.changed(lit)
            self.assertGreater(moved.differing(lit, by=4), 0.005)
            (after,) = self.lamps(viewer)
            self.assertNotEqual(before, after)
            words = viewer.copied()
            self.assertIn("--sun=20,50", words)
            viewer.click("remove lamp", lambda: not viewer.has("ring=0"), "no ring")
            # Above the message that says what was copied.
            again = viewer.changed(moved)
            upper = (0, 0, dark.width, dark.height // 3)
            self.assertEqual(again.crop(*upper), dark.crop(*upper))
            self.assertGreater(len(dark.crop(*upper).colors()), 30)
            self.assertEqual(self.lamps(viewer), [])

    def test_lights_of_the_file_are_turned_off_and_on(self):
        with self.view(scene("gallery"), "--technique", "hard") as viewer:
            viewer.open_tab("Scene", "eye")
            all_on = viewer.rest()
            viewer.click("light=2", lambda: True, "a light turned off")
            without = viewer.changed(all_on)
            self.assertGreater(without.differing(all_on, by=16), 0.01)
            self.assertIn("--lights=0,1,3", viewer.copied())
            viewer.click("light=2", lambda: True, "the light turned on")
            self.assertEqual(viewer.changed(without), all_on)
            viewer.click("no sun", lambda: True, "no sun")
            self.assertGreater(viewer.changed(all_on).differing(all_on, by=16), 0.001)
            self.assertIn("--no-sun", viewer.copied())


if __name__ == "__main__":
    main()
