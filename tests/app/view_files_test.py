"""penumbra view: pictures that it writes, the command line that it copies, and what it keeps until the next time."""

import shlex
import signal
import subprocess

from desktop import LEFT
from support import PROGRAM, main
from window import STEPS, WindowTest, read


class Files(WindowTest):
    def copied(self, viewer):
        """The picture that the copied command line draws."""
        viewer.open_tab("Files", "copy command")
        viewer.click("copy command", lambda: viewer.has("messages"), "a message")
        viewer.follow()
        command = shlex.split(self.desktop.client.clipboard())
        self.assertEqual(command[:2], ["penumbra", "render"])
        output = self.folder / "copied"
        output.mkdir()
        subprocess.run([PROGRAM, *command[1:]], cwd=output, check=True, capture_output=True)
        return read(next(output.iterdir()))

    def written(self, viewer):
        path = self.folder / "penumbra.png"
        viewer.press("F12", lambda: viewer.has("writing") or path.exists(), "the picture to be written")
        viewer.wait_for(lambda: path.exists() and not viewer.has("writing"), "the written picture")
        return read(path)

    def check_same(self, *options, move):
        with self.view(STEPS, *options, size=(640, 400)) as viewer:
            viewer.open_tab("Scene", "eye")
            if move:
                before = viewer.rest()
                eye = viewer.seen("eye")
                viewer.drag(*viewer.middle("picture"), LEFT, lambda: viewer.seen("eye") != eye, "another eye")
                viewer.changed(before)
            shown, copied, written = viewer.rest(), self.copied(viewer), self.written(viewer)
            self.assertEqual(copied, written)
            part = written.crop(0, written.height // 3, written.width, written.height * 3 // 4)
            self.assertEqual(part.differing(shown, by=1), 0)

    def test_a_picture_that_a_hand_has_turned(self):
        self.check_same("--technique", "pcf", "--set", "sun.angle=4", move=True)

    def test_a_picture_of_a_technique_with_memory(self):
        self.check_same("--set", "history.reuse=on", "--set", "sun.angle=4", move=False)

    def test_the_next_run_begins_as_the_last_one_ended(self):
        home = self.folder / "home"
        home.mkdir()
        size = (700, 500)
        last = {"home": home, "maps": ()}  # parameters of the command line would take the place of those that were kept
        with self.view(STEPS, **last, size=size) as viewer:
            before = viewer.rest()
            viewer.choose("technique", "none")
            wanted = viewer.changed(before)
            viewer.open_tab("Scene", "eye")
            viewer.tap("Escape")
            self.assertEqual(viewer.exit_code(), 0)
        with self.view(**last, size=None) as viewer:
            self.assertEqual(self.desktop.client.size(viewer.window), size)
            self.assertTrue(viewer.has("eye"))
            self.assertEqual(viewer.rest(), wanted)
            self.assertEqual(viewer.signal(signal.SIGTERM), 128 + signal.SIGTERM)
        with self.view(**last, size=None) as viewer:
            self.assertEqual(viewer.rest(), wanted)
            viewer.tap("Escape")
            self.assertEqual(viewer.exit_code(), 0)
        kept = {path: path.read_bytes() for path in (home / "config").rglob("*.json")}
        self.assertNotEqual(kept, {})
        with self.view(STEPS, "--defaults", **last, size=size) as viewer:
            self.assertEqual(viewer.rest(), before)
            viewer.choose("technique", "hard")
            viewer.changed(before)
            viewer.tap("Escape")
            self.assertEqual(viewer.exit_code(), 0)
        self.assertEqual({path: path.read_bytes() for path in (home / "config").rglob("*.json")}, kept)


if __name__ == "__main__":
    main()
