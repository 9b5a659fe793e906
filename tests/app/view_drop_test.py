"""penumbra view: files that are dropped on its window."""

from support import main
from window import KNIFE_EDGE, STEPS, WindowTest


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
            self.assertEqual(viewer.stderr(), "")

    def test_a_name_may_have_any_letters(self):
        path = self.folder / "Stufen & Kanten 100% ü.glb"
        path.write_bytes(KNIFE_EDGE.read_bytes())
        with self.view(STEPS) as viewer:
            before = viewer.rest()
            self.drop(viewer, path)
            viewer.changed(before)
            self.assertFalse(viewer.has("messages"))

    def test_a_file_that_is_no_scene_is_told_and_the_last_one_stays(self):
        cut = self.folder / "cut.glb"
        cut.write_bytes(STEPS.read_bytes()[:1000])
        text = self.folder / "text.txt"
        text.write_text("no scene\n")
        preset = self.folder / "bad.toml"
        preset.write_text("technique = [\n")
        with self.view(STEPS) as viewer:
            before = viewer.rest()
            for path in (cut, text, preset, self.folder, self.folder / "none.glb"):
                with self.subTest(path=path.name):
                    resting = viewer.seen("messages") if viewer.has("messages") else None
                    self.drop(viewer, path)
                    viewer.wait_for(lambda resting=resting: viewer.has("messages") and
                                    viewer.seen("messages") != resting, "a message")
                    self.assertEqual(viewer.rest(), before)
            viewer.choose("technique", "none")
            viewer.changed(before)
            self.assertEqual(viewer.stderr(), "")

    def test_a_preset_sets_the_values(self):
        wanted = self.picture_of(STEPS, "--technique", "none")
        preset = self.folder / "mine.toml"
        preset.write_text('technique = "none"\n')
        with self.view(STEPS) as viewer:
            before = viewer.rest()
            self.drop(viewer, preset)
            self.assertEqual(viewer.changed(before), wanted)
            self.assertEqual(viewer.stderr(), "")


if __name__ == "__main__":
    main()
