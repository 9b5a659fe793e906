"""penumbra watch: a picture that follows its files; penumbra glsl: files to start from."""

import json
import queue
import re
import shutil
import signal
import struct
import subprocess
import threading

from pictures import SMALL, SMALL_MAPS, scene
from support import PROGRAM, ROOT, TestCase, main, run

POSTS, STEPS = scene("posts"), scene("steps")
PATIENCE = 240  # seconds: for a busy machine


class Process:
    """A running `penumbra watch`; its lines arrive as they are printed."""

    def __init__(self, *arguments):
        self.process = subprocess.Popen([PROGRAM, "watch", *map(str, arguments)], stdout=subprocess.PIPE,
                                        stderr=subprocess.PIPE, text=True)
        self.lines = queue.Queue()
        for stream in (self.process.stdout, self.process.stderr):
            threading.Thread(target=self.read, args=(stream,), daemon=True).start()

    def read(self, stream):
        for line in stream:
            self.lines.put(line.rstrip("\n"))

    def next(self, pattern):
        """The next line that matches; all lines up to it are in `passed`."""
        self.passed = []
        while True:
            try:
                line = self.lines.get(timeout=PATIENCE)
            except queue.Empty:
                raise AssertionError(f"no line like '{pattern}' after {self.passed}") from None
            self.passed.append(line)
            if re.search(pattern, line):
                return line

    def end(self, number=signal.SIGINT):
        if self.process.poll() is None:
            self.process.send_signal(number)
        code = self.process.wait(timeout=PATIENCE)
        self.process.stdout.close()
        self.process.stderr.close()
        return code


class Watch(TestCase):
    def setUp(self):
        super().setUp()
        self.picture = self.folder / "out" / "x.png"
        self.glsl = self.folder / "glsl"
        self.glsl.mkdir()

    def watch(self, *arguments, of=POSTS, size=SMALL):
        process = Process(of, "-o", self.picture, *size, *SMALL_MAPS, *arguments)
        self.addCleanup(process.end, signal.SIGKILL)
        return process

    def assert_drawn_as_by_render(self, *arguments, of=POSTS):
        self.succeed("render", of, "-o", self.folder / "reference.png", *SMALL, *SMALL_MAPS, "--quiet", *arguments)
        self.assertEqual(self.picture.read_bytes(), (self.folder / "reference.png").read_bytes())

    def overlay(self, name, *changes):
        """A built-in shader with texts replaced, as text."""
        text = (ROOT / "glsl" / name).read_text()
        for old, new in changes:
            self.assertIn(old, text)
            text = text.replace(old, new)
        (self.glsl / name).parent.mkdir(parents=True, exist_ok=True)
        return text

    def test_the_picture_follows_an_include_a_preset_and_a_broken_shader(self):
        preset = self.folder / "mine.toml"
        preset.write_text('technique = "hard"\n')
        options = ("--glsl", self.glsl, "--preset", preset)
        watch = self.watch(*options)
        watch.next(rf"^watching .*{POSTS.name}, .*mine\.toml, .*glsl; Ctrl-C ends$")
        watch.next(r"^wrote \S+x\.png \(96×54, hard, frame \d+\.\d ms\)$")
        self.assertEqual(len(watch.passed), 1)
        self.assert_drawn_as_by_render(*options)

        name = "lib/tone_map.glsl"
        good = self.overlay(name)
        darker = good.replace("return ", "return 0.5 * ")
        (self.glsl / name).write_text(darker)
        line = watch.next(r"wrote")
        self.assertRegex(line, rf"^\S+{name} changed: wrote \S+ \(.*, \d+ programs? rebuilt in \d+\.\d ms, "
                               r"differs by \d+\.\d{3} of 255 in the mean, \d+ at most\)$")
        self.assert_drawn_as_by_render(*options)

        before = self.picture.read_bytes()
        lines = darker.splitlines()
        (self.glsl / name).write_text("\n".join([*lines, "float broken() { return missing; }"]))
        watch.next(rf"^{re.escape(str(self.glsl / name))}:{len(lines) + 1}: .*missing")
        self.assertRegex(watch.passed[0], r"^error: program '.*': the \w+ shader does not compile$")
        watch.next(r"^    float broken\(\) \{ return missing; \}$")
        self.assertEqual(self.picture.read_bytes(), before)

        preset.write_text('technique = "pcss"\n')  # the picture would need the broken shader
        watch.next(rf"{name}:{len(lines) + 1}: ")
        self.assertEqual(self.picture.read_bytes(), before)

        replacement = self.glsl / "lib" / ".saved"
        replacement.write_text(darker)
        replacement.rename(self.glsl / name)
        self.assertRegex(watch.next(r"wrote"), r"pcss.*differs by")
        self.assert_drawn_as_by_render(*options)

        preset.write_text('technique = "pcss"\n[pcss]\nfilter_taps = "many"\n')
        watch.next(r"^error: .*mine\.toml:3: ")
        preset.write_text('technique = "thesis_8x8"\n')
        self.assertRegex(watch.next(r"wrote"), r"^\S+mine\.toml changed: .*differs")
        self.assert_drawn_as_by_render(*options)

        (self.glsl / name).unlink()  # the built-in one is back
        watch.next(r"tone_map\.glsl changed: wrote")
        self.assert_drawn_as_by_render("--preset", preset)
        self.assertEqual(watch.end(), 130)

    def test_other_shaders_find_no_history(self):
        name = "shadow/techniques/pcss.glsl"
        changed = self.overlay(name, ("return soft_shadow(", "Visibility v = soft_shadow("),
                               ("!= 0);", "!= 0);\n  v.visibility *= 0.5;\n  return v;"))
        options = ("--technique", "thesis", "--glsl", self.glsl)
        watch = self.watch(*options)
        watch.next("^wrote")
        (self.glsl / name).write_text(changed)
        watch.next("wrote.*differs")
        self.assert_drawn_as_by_render(*options)

    def test_the_picture_follows_the_scene(self):
        model = self.folder / "model.glb"
        shutil.copy(POSTS, model)
        watch = self.watch("--technique", "thesis", "--warmup", "2", of=model)
        watch.next("^wrote")
        shutil.copy(STEPS, model)
        self.assertRegex(watch.next("wrote"), r"^\S+model\.glb changed: .*differs by")
        self.assert_drawn_as_by_render("--technique", "thesis", "--warmup", "2", of=model)
        before = self.picture.read_bytes()
        model.write_bytes(b"glTF, but not really")
        watch.next(r"^error: .*model\.glb")
        self.assertEqual(self.picture.read_bytes(), before)
        model.unlink()
        watch.next(r"^error: .*model\.glb")
        shutil.copy(POSTS, self.folder / "next.glb")
        (self.folder / "next.glb").rename(model)
        watch.next("wrote")
        self.assert_drawn_as_by_render("--technique", "thesis", "--warmup", "2", of=model)
        self.assertEqual(watch.end(signal.SIGTERM), 143)

    def test_the_picture_follows_files_that_the_scene_names(self):
        data = self.folder / "data.bin"
        write_triangle(data, 1.0)
        (self.folder / "model.gltf").write_text(json.dumps(triangle("data.bin")))
        watch = self.watch("--ground", "on", "--eye", "0,2,6", "--target", "0,0,0", of=self.folder / "model.gltf")
        watch.next("^wrote")
        write_triangle(data, 2.0)
        self.assertRegex(watch.next("wrote"), r"^\S+data\.bin changed: .*differs by")

    def test_a_file_that_a_changed_scene_lacked_is_read_once_it_is_there(self):
        model = self.folder / "model.gltf"
        write_triangle(self.folder / "data.bin", 1.0)
        model.write_text(json.dumps(triangle("data.bin")))
        watch = self.watch("--ground", "on", "--eye", "0,2,6", "--target", "0,0,0", of=model)
        watch.next("^wrote")
        model.write_text(json.dumps(triangle("other.bin")))
        watch.next(r"^error: .*model\.gltf.*other\.bin")
        write_triangle(self.folder / "other.bin", 2.0)
        self.assertRegex(watch.next("wrote"), r"^\S+other\.bin changed: .*differs by")

    def test_a_technique_whose_shader_is_broken_when_it_is_first_needed(self):
        preset = self.folder / "mine.toml"
        preset.write_text('technique = "hard"\n')
        name = "shadow/techniques/pcf.glsl"
        good = self.overlay(name)
        (self.glsl / name).write_text(good + "oops\n")
        watch = self.watch("--glsl", self.glsl, "--preset", preset)
        watch.next("^wrote")  # it takes no part
        preset.write_text('technique = "pcf"\n')
        watch.next(r"^error: program 'pcf'")
        watch.next(rf"^{re.escape(str(self.glsl / name))}:")
        (self.glsl / name).write_text(good)
        self.assertRegex(watch.next("wrote"), r"pcf\.glsl changed: .*\bpcf,")
        self.assert_drawn_as_by_render("--technique", "pcf")

    def test_it_starts_with_a_broken_shader(self):
        name = "lib/tone_map.glsl"
        good = self.overlay(name)
        (self.glsl / name).write_text(good + "oops\n")
        watch = self.watch("--glsl", self.glsl)
        watch.next("^watching ")
        watch.next("^error: ")
        self.assertFalse(self.picture.exists())
        (self.glsl / name).write_text(good)
        watch.next("wrote")
        self.assert_drawn_as_by_render()

    def test_a_saved_file_that_changes_nothing_says_so(self):
        watch = self.watch("--glsl", self.glsl, "--technique", "hard")
        watch.next("^wrote")
        text = self.overlay("lib/tone_map.glsl")
        (self.glsl / "lib/tone_map.glsl").write_text(text)
        watch.next(r"the same picture as before\)$")

    def test_stats_aovs_and_presets_are_written_each_time(self):
        preset = self.folder / "mine.toml"
        preset.write_text('technique = "hard"\n')
        stats, saved = self.folder / "stats.json", self.folder / "saved.toml"
        watch = self.watch("--preset", preset, "--aov", "shadow", "--stats", stats, "--save-preset", saved)
        watch.next("^wrote")
        self.assertEqual(json.loads(stats.read_text())["technique"], "hard")
        preset.write_text('technique = "pcf"\n')
        watch.next("wrote")
        self.assertEqual(json.loads(stats.read_text())["technique"], "pcf")
        self.assertIn('"pcf"', saved.read_text())
        self.assertTrue((self.folder / "out" / "x.shadow.png").exists())

    def test_signals_leave_nothing_behind(self):
        watch = self.watch("--quiet", "--technique", "hard", "--glsl", self.glsl, size=("--size", "640x360"))
        text = self.overlay("lib/tone_map.glsl")
        (self.glsl / "lib").mkdir(exist_ok=True)
        for i in range(50):
            (self.glsl / "lib/tone_map.glsl").write_text(f"{text}// {i}\n")
            if self.picture.exists():
                break
            try:
                watch.process.wait(timeout=1)
            except subprocess.TimeoutExpired:
                pass
        self.assertEqual(watch.end(), 130)
        self.assertLessEqual({path.name for path in self.picture.parent.iterdir()}, {"x.png"})

    def test_wrong_command_lines(self):
        output = ("-o", self.picture, *SMALL)
        self.assertIn("--frames", self.refuse("watch", POSTS, *output, "--frames", "0:3", code=2))
        preset = self.folder / "mine.toml"
        preset.write_text("sun.angle = 1\n")
        self.assertIn("--save-preset", self.refuse("watch", POSTS, *output, "--preset", preset, "--save-preset",
                                                   preset, code=2))
        self.refuse("watch", self.folder / "none.glb", *output)
        self.refuse("watch", POSTS, *output, "--preset", self.folder / "none.toml")
        self.assertNotIn("--frames", self.succeed("watch", "--help").stdout)


class Glsl(TestCase):
    def test_the_built_in_shaders_are_written(self):
        result = self.succeed("glsl", self.folder / "a" / "b")
        self.assertRegex(result.stdout, r"^wrote \d+ shader files to \S+b\n$")
        written = {path.relative_to(self.folder / "a" / "b") for path in (self.folder / "a" / "b").rglob("*.*")}
        self.assertGreater(len(written), 20)
        for path in written:
            self.assertEqual((self.folder / "a" / "b" / path).read_bytes(), (ROOT / "glsl" / path).read_bytes())

    def test_the_picture_is_the_same_with_them(self):
        self.succeed("glsl", self.folder / "glsl", "--quiet")
        for name, options in (("a.png", ()), ("b.png", ("--glsl", self.folder / "glsl"))):
            self.succeed("render", POSTS, "-o", self.folder / name, *SMALL, *SMALL_MAPS, "--quiet", *options)
        self.assertEqual((self.folder / "a.png").read_bytes(), (self.folder / "b.png").read_bytes())

    def test_what_is_there_is_kept(self):
        changed = self.folder / "lib" / "tone_map.glsl"
        changed.parent.mkdir()
        changed.write_text("mine")
        self.assertIn("tone_map.glsl", self.refuse("glsl", self.folder))
        self.assertEqual([path.name for path in self.folder.rglob("*.*")], ["tone_map.glsl"])
        self.assertEqual(changed.read_text(), "mine")
        self.succeed("glsl", self.folder, "--force")
        self.assertNotEqual(changed.read_text(), "mine")

    def test_places_that_cannot_be_written(self):
        (self.folder / "file").write_text("a file")
        self.refuse("glsl", self.folder / "file")
        self.refuse("glsl", code=2)
        self.refuse("glsl", "", code=2)
        self.assertEqual(run("glsl", "--help").returncode, 0)


def triangle(buffer):
    """A glTF document of one triangle whose positions are in a file."""
    return {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                           "min": [-2, 0, 0], "max": [2, 4, 0]}],
            "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"uri": buffer, "byteLength": 36}]}


def write_triangle(path, size):
    points = (-size, 0, 0, size, 0, 0, 0, size, 0)
    path.write_bytes(struct.pack("<9f", *points))


if __name__ == "__main__":
    main()
