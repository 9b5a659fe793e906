"""penumbra view: files that are dropped on its window."""

import pictures
from support import main
from window import KNIFE_EDGE, STEPS, WindowTest

MOVING = pictures.scene("moving")


def is_error_color(color):
    """The interface's red, of which letters are."""
    red, green, blue = color
    return red > 200 and 80 < green < 140 and 70 < blue < 130


class Drop(WindowTest):
    def drop(self, viewer, *paths):
        self.desktop.client.drop(viewer.window, *viewer.middle("picture"), *paths)

    def test_a_scene_takes_the_place_of_the_last(self):
        wanted = self.picture_of(KNIFE_EDGE)
        with self.view(STEPS) as viewer:
            before = viewer.rest()
            self.drop(viewer, KNIFE_EDGE)
            self.assertEqual(viewer.changed(before), wanted)
            self.drop(viewer, STEPS)
            self.assertEqual(viewer.changed(wanted), before)

    def test_another_scene_does_not_play(self):
        with self.view(MOVING) as viewer:
            before = viewer.rest()
            viewer.press("space", lambda: not viewer.has("idle"), "the animation")
            self.drop(viewer, STEPS)
            viewer.wait_for(lambda: any(word.endswith("steps.glb") for word in viewer.copied()), "the other scene")
            still = viewer.rest()
            self.drop(viewer, MOVING)
            self.assertEqual(viewer.changed(still), before)

    def test_a_name_may_have_any_letters(self):
        path = self.folder / "Stufen & Kanten 100% ü.glb"
        path.write_bytes(KNIFE_EDGE.read_bytes())
        wanted = self.picture_of(KNIFE_EDGE)
        with self.view(STEPS) as viewer:
            before = viewer.rest()
            self.drop(viewer, path)
            self.assertEqual(viewer.changed(before), wanted)
            self.assertFalse(viewer.has("messages"))

    def test_a_file_that_is_no_scene_is_told_and_the_last_one_stays(self):
        cut = self.folder / "cut.glb"
        cut.write_bytes(STEPS.read_bytes()[:1000])
        text = self.folder / "text.txt"
        text.write_text("no scene\n")
        preset = self.folder / "bad.toml"
        preset.write_text("technique = [\n")
        for path in (cut, text, preset, self.folder, self.folder / "none.glb"):
            # A viewer each: messages go by themselves, so one more among others is hard to tell.
            with self.subTest(path=path.name), self.view(STEPS) as viewer:
                before = viewer.rest()
                self.drop(viewer, path)
                viewer.wait_for(lambda: viewer.has("messages"), "a message")
                self.assertTrue(any(map(is_error_color, viewer.seen("messages").colors())))
                self.assertEqual(viewer.rest(), before)
                viewer.choose("technique", "none")
                viewer.changed(before)

    def test_a_preset_sets_the_values(self):
        wanted = self.picture_of(STEPS, "--technique", "none")
        preset = self.folder / "mine.toml"
        preset.write_text('technique = "none"\n')
        with self.view(STEPS) as viewer:
            before = viewer.rest()
            self.drop(viewer, preset)
            self.assertEqual(viewer.changed(before), wanted)


if __name__ == "__main__":
    main()
