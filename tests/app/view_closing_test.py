"""penumbra view asks before it closes, or shows another scene, with changes that are not saved, and begins with what was
saved beside the scene."""

import base64
import json
import struct
import zlib

from desktop import LEFT, RIGHT
from support import main
from window import KNIFE_EDGE, STEPS, WindowTest


def slow_scene():
    """A scene that takes a while to read: a triangle with large textures."""
    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    def uri(kind, data):
        return {"uri": f"data:{kind};base64,{base64.b64encode(data).decode()}"}

    side = 4096
    png = (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", side, side, 8, 0, 0, 0, 0)) +
           chunk(b"IDAT", zlib.compress(bytes((side + 1) * side), 1)) + chunk(b"IEND", b""))
    corners = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)
    textures = ("normalTexture", "emissiveTexture", "occlusionTexture")
    return {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": 0}]}],
            "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}} |
                          {name: {"index": 1 + i} for i, name in enumerate(textures)}],
            "textures": [{"source": i} for i in range(4)], "images": [uri("image/png", png)] * 4,
            "buffers": [uri("application/octet-stream", corners) | {"byteLength": len(corners)}],
            "bufferViews": [{"buffer": 0, "byteLength": len(corners)}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0],
                           "max": [1, 1, 0]},
                          {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC2"}]}


class Closing(WindowTest):
    QUESTION, CANCEL = "closing=Save", "closing=Cancel"

    def setUp(self):
        super().setUp()
        self.scene = self.folder / "mine.glb"
        self.scene.write_bytes(STEPS.read_bytes())
        self.saved = self.folder / "mine.glb.view.json"

    def place(self, viewer, option="--sun"):
        return [word for word in viewer.copied() if word.startswith(option + "=")]

    def drag(self, viewer, button, option):
        """Drags over the picture until the option is another one, and returns it."""
        before = self.place(viewer, option)
        x, y = viewer.middle("picture")
        viewer.move(x, y)
        self.desktop.xdotool("mousedown", button)
        for step in (10, 60):
            viewer.follow()
            viewer.move(x + step, y + step // 2)
        viewer.follow()
        self.desktop.xdotool("mouseup", button)
        viewer.follow()
        self.assertNotEqual(self.place(viewer, option), before)
        return self.place(viewer, option)

    def ask(self, viewer, key):
        self.desktop.xdotool("key", key)
        viewer.wait_for(lambda: viewer.has(self.QUESTION), f"the question after {key}")

    def answer(self, viewer, answer):
        viewer.point_at(f"closing={answer}")
        self.desktop.xdotool("click", LEFT)

    def test_each_way_to_close_asks_and_escape_or_cancel_stays(self):
        with self.view("mine.glb") as viewer:
            sun = self.drag(viewer, RIGHT, "--sun")
            for key in ("Escape", "ctrl+q", "alt+F4"):
                with self.subTest(key=key):
                    self.ask(viewer, key)
                    viewer.press("Escape", lambda: not viewer.has(self.QUESTION), "no question")
                    self.ask(viewer, key)
                    viewer.press("Tab", lambda: True, "nothing")  # hides the panel where no question is open
                    self.assertTrue(viewer.has("technique"))
                    self.answer(viewer, "Cancel")
                    viewer.wait_for(lambda: not viewer.has(self.QUESTION), "no question")
            self.assertEqual(self.place(viewer), sun)
            self.assertFalse(self.saved.exists())
            viewer.tap("ctrl+z")
            viewer.follow()
            self.desktop.xdotool("key", "Escape")  # what was undone is no change
            self.assertEqual(viewer.exit_code(), 0)

    def test_discard_closes_and_writes_nothing(self):
        with self.view("mine.glb") as viewer:
            self.drag(viewer, RIGHT, "--sun")
            self.ask(viewer, "Escape")
            self.answer(viewer, "Discard")
            self.assertEqual(viewer.exit_code(), 0)
        self.assertFalse(self.saved.exists())

    def test_what_is_saved_is_what_the_next_start_shows(self):
        with self.view("mine.glb") as viewer:
            eye, sun = self.drag(viewer, LEFT, "--eye"), self.drag(viewer, RIGHT, "--sun")
            viewer.wait_for(lambda: not viewer.has("messages"), "no messages over the picture")
            shown = viewer.rest()
            self.ask(viewer, "alt+F4")
            self.answer(viewer, "Save")
            self.assertEqual(viewer.exit_code(), 0)
        self.assertIn(sun[0], json.loads(self.saved.read_text())["view"])
        with self.view("mine.glb") as viewer:
            self.assertEqual(viewer.rest(), shown)
            self.assertEqual((self.place(viewer, "--eye"), self.place(viewer)), (eye, sun))
            self.drag(viewer, LEFT, "--eye")
            viewer.tap("Escape")  # the camera alone asks nothing
            self.assertEqual(viewer.exit_code(), 0)
        with self.view("mine.glb", "--sun=10,30", "--defaults") as viewer:
            self.assertEqual((self.place(viewer, "--eye"), self.place(viewer)), ([], ["--sun=10,30"]))
            self.drag(viewer, RIGHT, "--sun")
            viewer.tap("Escape")
            self.assertEqual(viewer.exit_code(), 0)

    def test_another_scene_takes_its_place_only_after_the_question(self):
        other = self.folder / "other.glb"
        other.write_bytes(KNIFE_EDGE.read_bytes())
        with self.view("mine.glb") as viewer:
            sun = self.drag(viewer, RIGHT, "--sun")

            def ask(way):
                if way == "drop":
                    self.desktop.client.drop(viewer.window, *viewer.middle("picture"), other)
                else:
                    viewer.press("ctrl+o", lambda: viewer.has("open=other.glb"), "the list of files")
                    viewer.point_at("open=other.glb")
                    self.desktop.xdotool("click", LEFT)
                viewer.wait_for(lambda: viewer.has(self.QUESTION), "the question")

            for way in ("drop", "list"):
                for stay in (lambda: self.answer(viewer, "Cancel"), lambda: self.desktop.xdotool("key", "Escape")):
                    ask(way)
                    stay()
                    viewer.wait_for(lambda: not viewer.has(self.QUESTION), "no question")
                    self.assertEqual(self.place(viewer), sun)
                    self.assertIn("mine.glb", viewer.copied())
            ask("drop")
            self.answer(viewer, "Discard")
            viewer.wait_for(lambda: any(word.endswith("other.glb") for word in viewer.copied()), "the other scene")
            self.assertFalse(self.saved.exists())
            viewer.rest()
            self.desktop.client.drop(viewer.window, *viewer.middle("picture"), self.scene)  # nothing to lose: no question
            viewer.wait_for(lambda: any(word.endswith("mine.glb") for word in viewer.copied()), "the first scene")
            self.assertEqual(self.place(viewer), [])
            viewer.rest()
            sun = self.drag(viewer, RIGHT, "--sun")
            self.desktop.client.drop(viewer.window, *viewer.middle("picture"), self.scene)  # the same scene keeps them
            viewer.follow()
            viewer.rest()
            self.assertFalse(viewer.has(self.QUESTION))
            ask("drop")
            self.answer(viewer, "Save")
            viewer.wait_for(lambda: any(word.endswith("other.glb") for word in viewer.copied()), "the other scene")
            self.assertIn(sun[0], json.loads(self.saved.read_text())["view"])

    def test_what_is_changed_while_another_scene_is_read_is_asked_for_too(self):
        other = self.folder / "other.gltf"
        other.write_text(json.dumps(slow_scene()))
        with self.view("mine.glb") as viewer:
            self.desktop.client.drop(viewer.window, *viewer.middle("picture"), other)
            self.desktop.xdotool("key", "ctrl+1")
            viewer.wait_for(lambda: viewer.has(self.QUESTION), "the question")
            self.answer(viewer, "Cancel")
            viewer.wait_for(lambda: not viewer.has(self.QUESTION), "no question")
            self.assertIn("mine.glb", viewer.copied())
            self.desktop.client.drop(viewer.window, *viewer.middle("picture"), other)
            viewer.wait_for(lambda: viewer.has(self.QUESTION), "the question before it is read")
            self.answer(viewer, "Discard")
            viewer.wait_for(lambda: any(word.endswith("other.gltf") for word in viewer.copied()), "the other scene")
            viewer.rest()

    def test_pictures_that_are_being_written_are_not_ended_without_a_question(self):
        close = "closing=Close"
        with self.view("mine.glb", "--technique", "brute_force", "--set", "sun.angle=20") as viewer:
            viewer.open_tab("Files", "write sequence")
            viewer.click("write sequence", lambda: viewer.has("writing"), "pictures that are being written")
            for answer in ("Cancel", "Close"):
                self.desktop.xdotool("key", "Escape")
                viewer.wait_for(lambda: viewer.has(close), "the question")
                self.assertFalse(viewer.has(self.QUESTION))
                self.answer(viewer, answer)
                if answer == "Cancel":
                    viewer.wait_for(lambda: not viewer.has(close), "no question")
                    self.assertTrue(viewer.has("writing"))
            self.assertEqual(viewer.exit_code(), 0)

    def test_pictures_that_are_being_written_can_be_stopped(self):
        with self.view("mine.glb", "--technique", "brute_force", "--set", "sun.angle=20") as viewer:
            viewer.open_tab("Files", "write sequence")
            viewer.click("write sequence", lambda: viewer.has("writing"), "pictures that are being written")
            pictures = lambda: len(list(self.folder.glob("penumbra*.png")))
            viewer.wait_for(pictures, "the first picture")
            viewer.click("stop writing", lambda: viewer.has("write sequence"), "the end of writing")
            self.assertLess(pictures(), 40, "of 48")

    def test_a_window_that_is_minimised_comes_back_to_ask(self):
        with self.view("mine.glb") as viewer:
            self.drag(viewer, RIGHT, "--sun")
            self.desktop.xdotool("windowminimize", viewer.window)
            viewer.wait_for(lambda: self.desktop.find_window(viewer.process.pid) is None, "an icon")
            self.desktop.client.ask_to_close(viewer.window)
            viewer.wait_for(lambda: self.desktop.find_window(viewer.process.pid), "the window")
            viewer.wait_for(lambda: viewer.has(self.QUESTION), "the question")

    def test_a_view_that_cannot_be_read_is_told_and_kept(self):
        broken = '{"view": ["--eye=nan,0,0", "--target=0,0,0"]}'
        self.saved.write_text(broken)
        with self.view("mine.glb") as viewer:
            viewer.wait_for(lambda: viewer.has("messages"), "a message")
            self.drag(viewer, RIGHT, "--sun")
            self.ask(viewer, "Escape")
            self.answer(viewer, "Save")
            viewer.wait_for(lambda: not viewer.has(self.QUESTION), "no question")
            viewer.follow()
            self.assertEqual(self.saved.read_text(), broken)
            self.ask(viewer, "Escape")
            self.answer(viewer, "Discard")
            self.assertEqual(viewer.exit_code(), 0)

    def test_lights_of_a_saved_view_that_the_scene_lacks_are_left_out(self):
        self.saved.write_text('{"view": ["--sun=20,40", "--lights=0,1,2"], "bookmarks": {}}')
        with self.view("mine.glb") as viewer:
            viewer.wait_for(lambda: viewer.has("messages"), "a message")
            before = viewer.rest()
            self.assertEqual(self.place(viewer), ["--sun=20,40"])
            self.assertEqual(self.place(viewer, "--lights"), [])
            self.drag(viewer, LEFT, "--eye")
            self.assertGreater(viewer.changed(before).differing(before, by=8), 0.01)

    def test_enter_answers_the_question(self):
        with self.view("mine.glb") as viewer:
            sun = self.drag(viewer, RIGHT, "--sun")
            self.ask(viewer, "Escape")
            viewer.tap("Return")
            self.assertEqual(viewer.exit_code(), 0)
        self.assertEqual(json.loads(self.saved.read_text())["view"], sun)

    def test_a_preset_file_is_overwritten_by_what_it_was_opened_as_alone(self):
        preset = self.folder / "preset.toml"
        first = 'technique = "pcf"  # mine\n'
        preset.write_text(first)
        with self.view("mine.glb", maps=()) as viewer:
            self.desktop.client.drop(viewer.window, *viewer.middle("picture"), preset)
            viewer.wait_for(lambda: "--technique=pcf" in viewer.copied(), "the preset")
            viewer.tap("ctrl+z")
            viewer.wait_for(lambda: "--technique=pcf" not in viewer.copied(), "what was there before")
            viewer.tap("ctrl+s")
            viewer.wait_for(self.saved.exists, "the view")
            viewer.follow()
            self.assertEqual(preset.read_text(), first)
            viewer.tap("ctrl+y")  # it is open again
            viewer.wait_for(lambda: "--technique=pcf" in viewer.copied(), "the preset")
            viewer.choose("technique", "none")
            viewer.open_tab("Scene", "eye")
            viewer.tap("ctrl+s")
            viewer.wait_for(lambda: viewer.has("overwrite preset"), "the question")
            self.assertEqual(preset.read_text(), first)
            viewer.click("overwrite preset", lambda: preset.read_text() != first, "the file")
        self.assertIn('"none"', preset.read_text())

    def test_a_preset_with_the_values_that_are_set_stays_open(self):
        preset = self.folder / "preset.toml"
        preset.write_text('technique = "slices_denoised"\n')
        with self.view("mine.glb", maps=()) as viewer:
            self.desktop.client.drop(viewer.window, *viewer.middle("picture"), preset)
            viewer.wait_for(lambda: viewer.has("messages"), "a message")
            self.drag(viewer, LEFT, "--eye")
            viewer.tap("ctrl+z")
            viewer.wait_for(lambda: not self.place(viewer, "--eye"), "the first camera")
            viewer.find("slices.azimuths")
            viewer.fill_in("slices.azimuths", "5", lambda: "--set=slices.azimuths=5" in " ".join(viewer.copied()), "the value")
            viewer.tap("ctrl+s")
            viewer.wait_for(lambda: "azimuths" in preset.read_text(), "the file without a question")

    def test_a_preset_is_saved_where_the_view_cannot_be(self):
        broken = '{"view": ["--eye=nan,0,0", "--target=0,0,0"]}'
        self.saved.write_text(broken)
        preset = self.folder / "preset.toml"
        preset.write_text('technique = "pcf"\n')
        with self.view("mine.glb", "--preset", "preset.toml", maps=()) as viewer:
            viewer.choose("technique", "none")
            self.ask(viewer, "Escape")
            self.answer(viewer, "Save")
            self.assertEqual(viewer.exit_code(), 0)
        self.assertIn('"none"', preset.read_text())
        self.assertEqual(self.saved.read_text(), broken)

    def test_a_scene_that_was_not_loaded_has_no_view_to_save(self):
        self.scene.write_text("no scene")
        preset = self.folder / "preset.toml"
        preset.write_text('technique = "pcf"\n')
        with self.view("mine.glb", "--sun=10,30", rests=False) as viewer:
            viewer.wait_for(lambda: viewer.has("messages"), "a message")
            viewer.tap("Escape")
            self.assertEqual(viewer.exit_code(), 0)
        with self.view("mine.glb", "--sun=10,30", "--preset", "preset.toml", maps=(), rests=False) as viewer:
            viewer.wait_for(lambda: viewer.has("messages"), "a message")
            viewer.choose("technique", "none")
            self.ask(viewer, "Escape")
            self.answer(viewer, "Save")
            self.assertEqual(viewer.exit_code(), 0)
        self.assertIn('"none"', preset.read_text())
        self.assertFalse(self.saved.exists())

    def test_the_parameters_of_a_preset_that_is_open(self):
        preset = self.folder / "preset.toml"
        first = 'technique = "pcf"\n'
        preset.write_text(first)
        for answer in ("Discard", "Save"):
            with self.subTest(answer=answer), self.view("mine.glb", "--preset", "preset.toml", maps=()) as viewer:
                viewer.choose("technique", "none")
                self.ask(viewer, "Escape")
                self.answer(viewer, answer)
                self.assertEqual(viewer.exit_code(), 0)
                self.assertEqual(preset.read_text() == first, answer == "Discard")
        self.assertIn('"none"', preset.read_text())


if __name__ == "__main__":
    main()
