"""Wrong usage: one line on stderr, exit code 2, near names, nothing drawn."""

import json
import os
import re
import struct
import subprocess

from pictures import SMALL, SMALL_MAPS, scene
from support import PROGRAM, TestCase, has_viewer, main, run, without_root

POSTS = scene("posts")


class Usage(TestCase):
    def wrong(self, *arguments):
        return self.refuse(*arguments, code=2, cwd=self.folder)

    def wrong_render(self, *arguments):
        error = self.wrong("render", POSTS, "-o", "x.png", *arguments)
        self.assertEqual(list(self.folder.iterdir()), [])
        return error

    def test_version_and_help_succeed(self):
        self.assertRegex(self.succeed("--version").stdout, r"^Penumbra \d+\.\d+\.\d+\n$")
        for arguments in (["--help"], ["help"], ["render", "--help"], ["help", "render"], ["list", "-h"]):
            self.assertIn("penumbra", self.succeed(*arguments).stdout)
        for command in ("render", "info", "list", "help", "doctor"):
            self.assertIn(command, self.succeed("help").stdout)

    def test_commands(self):
        self.assertIn("no command", self.wrong())
        self.assertIn("'render'", self.wrong("rendr"))
        self.assertIn("'--quiet'", self.wrong("--quiet", "render"))

    def test_what_is_missing_or_too_much(self):
        self.assertIn("SCENE", self.wrong("render", "-o", "x.png"))
        self.assertIn("--output", self.wrong("render", POSTS))
        self.assertIn("--size", self.wrong_render("--size"))
        self.assertIn("given twice", self.wrong_render("--size", "1x1", "--size", "2x2"))
        self.assertIn("'more'", self.wrong_render("more"))
        self.assertIn("takes no value", self.wrong_render("--quiet=yes"))

    def test_unknown_names_list_near_ones(self):
        for arguments, near in (
            (["--siez", "1x1"], "'--size'"),
            (["--technique", "pccs"], "'pcss'"),
            (["--technique", "pscc"], "did you mean 'pcss'?"),
            (["--technique", "thesi"], "'thesis'"),
            (["--set", "sun.angel=1"], "'sun.angle'"),
            (["--aov", "shadow,dept"], "'depth'"),
            (["--aov", "shadow", "--aov-samples", "al"], "'all'"),
            (["--backend", "elg"], "'egl'"),
            (["--log-level", "warn"], "'warning'"),
            (["--ground", "onn"], "'on'"),
        ):
            with self.subTest(arguments):
                self.assertIn(near, self.wrong_render(*arguments))
        self.assertIn("'sun.angle'", self.wrong("help", "sun.angel"))
        self.assertIn("'params'", self.wrong("list", "parms"))

    def test_a_scenes_cameras_are_its_own(self):
        error = self.refuse("render", POSTS, "-o", self.folder / "x.png", "--camera", "mian")
        self.assertIn("'main'", error)
        self.refuse("render", POSTS, "-o", self.folder / "x.png", "--camera", "999")
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_numbers_are_strict(self):
        # Each option's range; unit tests hold the parsers' other refusals.
        for option, texts in {
            "--size": ["0x10", "16385x1"],
            "--fov": ["180", ""],
            "--sun": ["10,91"],
            "--sun-angle": ["-1"],
            "--exposure": ["nan", "Auto", "30"],
            "--time": ["inf"],
            "--frames": ["2:1"],
            "--frame": ["-1", "0:1"],
            "--fps": ["0"],
            "--warmup": ["1.5"],
            "--supersample": ["17"],
            "--samples": ["0", "257", "1.5"],
            "--threads": ["0"],
            "--stats-frames": ["0"],
            "--egl-device": ["-1"],
        }.items():
            for text in texts:
                with self.subTest(f"{option}={text}"):
                    self.wrong_render(f"{option}={text}")

    def test_options_that_exclude_each_other(self):
        for arguments in (
            ["--eye", "1,2,3"],
            ["--target", "1,2,3"],
            ["--eye=1,2,3", "--target=1,2,3"],
            ["--eye=0,0,0", "--target=0,0,1e-30"],
            ["--eye=1,2,3", "--target=0,0,0", "--camera", "0"],
            ["--egl-device", "0", "--backend", "osmesa"],
            ["--stats-frames", "3"],
            ["--warmup-still"],
            ["--aov-samples", "all"],
            ["--size", "16384x16384"],
            ["--size", "9000x100", "--supersample", "2"],
        ):
            with self.subTest(arguments):
                self.wrong_render(*arguments)

    def test_no_option_takes_an_empty_text(self):
        for option in ("--technique", "--camera", "--exposure", "--sun-angle", "--stats", "--save-preset", "--glsl",
                       "--aov", "--preset", "--set", "--backend"):
            with self.subTest(option):
                if option == "--preset":
                    self.refuse("render", POSTS, "-o", self.folder / "x.png", option, "")
                else:
                    self.wrong_render(option, "")

    def test_a_result_takes_no_other_files_place(self):
        copy = self.folder / "scene.glb"
        copy.write_bytes(POSTS.read_bytes())
        (self.folder / "link.glb").symlink_to(copy)
        (self.folder / "here").symlink_to(self.folder)
        preset = self.folder / "p.toml"
        preset.write_text("sun.angle = 1\n")
        (self.folder / "shaders" / "own").mkdir(parents=True)
        (self.folder / "shaders" / "own" / "a.inc").write_text("// included\n")
        before = sorted(self.folder.iterdir())
        for of, arguments in (
            ("scene.glb", ["--stats", "scene.glb"]),
            ("scene.glb", ["--save-preset", self.folder / "scene.glb"]),
            ("scene.glb", ["--stats", "here/scene.glb"]),
            ("link.glb", ["--stats", "scene.glb"]),
            ("link.glb", ["--stats", "link.glb"]),
            ("scene.glb", ["--stats", "new/../x.png"]),
            ("scene.glb", ["--save-preset", "x.png"]),
            ("scene.glb", ["--stats", "x.depth.png", "--aov", "shadow,depth"]),
            ("scene.glb", ["--stats", "x_0003.png", "--frames", "0:4"]),
            ("scene.glb", ["--stats", "x_0003.shadow.png", "--frames", "0:4", "--aov", "shadow"]),
            ("scene.glb", ["--stats", "a.toml", "--save-preset", "./a.toml"]),
            ("scene.glb", ["--stats", "p.toml", "--preset", "p.toml"]),
            ("scene.glb", ["--stats", "shaders/own/a.inc", "--glsl", "shaders"]),
            ("scene.glb", ["--save-preset", "here/shaders/own/a.inc", "--glsl", "shaders"]),
        ):
            with self.subTest(arguments):
                self.wrong("render", of, "-o", "x.png", *arguments)
        picture = self.folder / "p.png"
        picture.write_text(preset.read_text())
        for command in ("render", "truth"):
            self.assertIn("the preset 'p.png'", self.wrong(command, "scene.glb", "-o", "p.png", "--preset", "p.png"))
        picture.unlink()
        self.assertEqual(sorted(self.folder.iterdir()), before)
        self.assertEqual(copy.read_bytes(), POSTS.read_bytes())
        self.succeed("render", copy, "-o", self.folder / "x.png", *SMALL, "--preset", preset, "--sun-angle", "2",
                     "--save-preset", preset)
        self.assertIn("angle = 2.0", preset.read_text())

    def test_a_result_takes_no_place_of_a_picture_of_a_long_sequence(self):
        for name, is_picture in (("x_40000.toml", False), ("x_40000.png", True), ("x_40000.depth.png", True),
                                 ("x_100000.png", False), ("x_0040000.png", False), ("x_.png", False)):
            with self.subTest(name):
                error = self.refuse("render", "missing.glb", "-o", "x_####.png", "--aov", "depth", "--frames", "0:99999",
                                    "--stats", name, code=2 if is_picture else 1, cwd=self.folder)
                self.assertEqual("is a picture of this command too" in error, is_picture, error)

    def test_a_preset_takes_no_place_of_another_kind_of_file(self):
        notes = self.folder / "README.md"
        notes.write_text("notes\n")
        for name in (notes, self.folder / "new.tom"):
            error = self.wrong("render", POSTS, "-o", "x.png", "--save-preset", name)
            self.assertIn("ends in .toml", error)
        with open(notes, "w") as file:
            subprocess.run([PROGRAM, "render", POSTS, "-o", self.folder / "x.png", *SMALL, "--quiet", "--save-preset", "-"],
                           stdout=file, check=True)
        self.assertIn("[", notes.read_text())
        notes.write_text("notes\n")
        (self.folder / "x.png").unlink()
        self.assertEqual(list(self.folder.iterdir()), [notes])

    def test_errors_say_what_would_be_right(self):
        picture = ("-o", self.folder / "x.png")
        for arguments, word in (
            (["render", POSTS, *picture, "--exposure", "bright"], "auto or a number from -16 to 24"),
            (["compare", POSTS, "-o", self.folder / "c", "--technique", "hard", "--frames", "0:3", "--orbit", "2",
              "--cut-at", "99"], "one of the frames 0:3"),
        ):
            with self.subTest(arguments):
                self.assertIn(word, self.wrong(*arguments))
        self.assertIn("'': file not found", self.refuse("render", "", *picture))

    def test_results_in_a_folder_spare_what_is_read(self):
        for name in ("index.html", "results.json", "figures.csv", "steps.csv"):
            (self.folder / name).write_bytes(POSTS.read_bytes())
        for arguments in (
            ["compare", "index.html", "-o", ".", "--technique", "hard"],
            ["compare", POSTS, "results.json", "-o", ".", "--technique", "hard"],
            ["compare", POSTS, "-o", ".", "--technique", "hard", "--preset", "index.html"],
            ["reproduce", "index.html", "-o", "."],
            ["reproduce", "./figures.csv", "-o", self.folder],
            ["bench", "steps.csv", "-o", "steps.csv"],
            ["bench", POSTS, "-o", "steps.csv", "--preset", "steps.csv"],
        ):
            with self.subTest(arguments):
                code = 1 if arguments[0] != "reproduce" and "--preset" in arguments else 2  # the preset is read first
                self.refuse(*arguments, code=code, cwd=self.folder)
        for path in self.folder.iterdir():
            self.assertEqual(path.read_bytes(), POSTS.read_bytes(), path)

    def test_buffers_beside_a_scene_are_spared(self):
        document = json.dumps({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 36, "uri": "index.html"}],
                               "bufferViews": [{"buffer": 0, "byteLength": 36}],
                               "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
                               "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}], "nodes": [{"mesh": 0}]})
        (self.folder / "s.gltf").write_text(document)
        buffer = self.folder / "index.html"
        buffer.write_bytes(struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0))
        before = buffer.read_bytes()
        for arguments in (["compare", "s.gltf", "-o", ".", "--technique", "hard", *SMALL],
                          ["compare", POSTS, "s.gltf", "-o", ".", "--technique", "hard", *SMALL],
                          ["reproduce", "s.gltf", "-o", ".", "--quick"],
                          ["bench", "s.gltf", "-o", "index.html", *SMALL]):
            with self.subTest(arguments):
                self.assertIn("the scene's file", self.wrong(*arguments))
        self.assertEqual(buffer.read_bytes(), before)

    def test_a_dash_is_standard_output(self):
        for option, start in (("--stats", "{"), ("--save-preset", "#")):
            result = self.succeed("render", POSTS, "-o", "x.png", *SMALL, *SMALL_MAPS, option, "-", cwd=self.folder)
            self.assertTrue(result.stdout.startswith(start), result.stdout)
            self.assertNotIn("wrote", result.stdout)
            if option == "--stats":
                json.loads(result.stdout)
        self.assertEqual([path.name for path in self.folder.iterdir()], ["x.png"])
        self.succeed("render", POSTS, "-o", "x.png", *SMALL, *SMALL_MAPS, "--stats", "./-", "--quiet",
                     cwd=self.folder)
        self.assertTrue((self.folder / "-").exists())
        (self.folder / "-").unlink()
        for arguments in (["render", POSTS, "-o", "-"], ["compare", POSTS, "-o", "-", "--technique", "hard"],
                          ["reproduce", "-o", "-"], ["glsl", "-"], ["bake", "points", "-o", "-"],
                          ["bench", POSTS, "-o", "-"]):
            with self.subTest(arguments):
                self.assertIn("'-", self.wrong(*arguments))
        self.assertFalse((self.folder / "-").exists())

    def test_an_option_is_no_value_of_another_one(self):
        error = self.refuse("render", POSTS, "-o", "--size", "16x16", code=2, cwd=self.folder)
        self.assertEqual(error, "error: --output lacks its value: '--size' is an option")
        self.assertNotIn("lacks its value", self.refuse("render", POSTS, "-o", "x.png", "--camera=--size", cwd=self.folder))
        error = self.wrong("render", POSTS, "-o", "--size=16x16")
        self.assertEqual(error, "error: --output lacks its value: '--size=16x16' is an option")
        error = self.wrong("render", "-o", "x.png", "--preset", "--", POSTS)
        self.assertEqual(error, "error: --preset lacks its value: '--' ends the options")
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_a_short_option_takes_no_equals_sign(self):
        for arguments in (["render", POSTS, "-o=o/x.png"], ["compare", POSTS, "--technique", "hard", "-o=o"]):
            self.assertIn("'--output='", self.wrong(*arguments))
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_memory_of_shadow_maps_has_a_limit(self):
        error = self.wrong_render("--set", "cascades.size=8192", "--set", "cascades.count=5")
        self.assertIn("cascades.size", error)
        self.assertIn("cascades.count", error)

    def test_no_error_lists_every_parameter(self):
        errors = [self.wrong_render("--set", "zzzzzzzz=1")]
        preset = self.folder / "p.toml"
        preset.write_text("zzzzzzzz = 1\n")
        errors.append(self.refuse("render", POSTS, "-o", self.folder / "x.png", "--preset", preset))
        for error in errors:
            self.assertLess(len(error), 200)
            self.assertIn("penumbra list params", error)

    def test_a_folder_of_shaders_must_exist(self):
        for glsl, cause in (("/no/folder", "nothing has that name"), (POSTS, "a file, not a folder")):
            error = self.refuse("render", POSTS, "-o", self.folder / "x.png", "--glsl", glsl)
            self.assertIn("--glsl", error)
            self.assertIn(cause, error)
        self.folder.chmod(0o777)
        locked = self.folder / "locked"
        locked.mkdir(0o311)
        self.addCleanup(locked.chmod, 0o755)
        error = self.refuse("render", POSTS, "-o", self.folder / "x.png", "--glsl", locked, **without_root())
        self.assertTrue(error.endswith(f"--glsl: '{locked}' can't be listed: Permission denied"), error)

    def test_a_shader_that_can_not_be_read_is_told(self):
        shader = self.folder / "glsl" / "lib" / "tone_map.glsl"
        shader.parent.mkdir(parents=True)

        def refused(cause, **options):
            error = self.refuse("render", POSTS, "-o", self.folder / "x.png", *SMALL, *SMALL_MAPS, "--technique",
                                "hard", "--glsl", self.folder / "glsl", timeout=60, **options)
            self.assertTrue(error.endswith(f"cannot read the shader '{shader}': {cause}"), error)
            shader.unlink()

        os.mkfifo(shader)
        refused("not a regular file")
        shader.symlink_to("nowhere")
        refused("file not found")
        shader.symlink_to("/proc/self/mem")
        refused("can't be read: Input/output error")
        shader.touch()
        os.truncate(shader, 200 << 20)
        refused("209715200 bytes, over the limit of 1048576")
        self.folder.chmod(0o777)
        shader.touch(0)
        refused("can't be read: Permission denied", **without_root())

    def test_help_explains_every_name(self):
        for what in ("techniques", "params", "aovs"):
            for row in self.listed(what):
                with self.subTest(row["name"]):
                    text = self.succeed("help", row["name"]).stdout
                    self.assertIn(row["help"], " ".join(text.split()))
                    self.assertLessEqual(max(map(len, text.splitlines())), 100)

    def test_help_explains_groups_of_parameters(self):
        names = [row["name"] for row in self.listed("params")]
        for group in ("filter", "cascades", "sun", "vsm"):
            text = self.succeed("help", group).stdout
            told = [line.split()[0] for line in text.splitlines() if line.startswith(f"  {group}.")]
            self.assertEqual(told, [name for name in names if name.startswith(f"{group}.")])
            self.assertLessEqual(max(map(len, text.splitlines())), 100)
        self.assertIn("'filter'", self.wrong("help", "filtr"))

    def test_help_of_every_command_fits_a_terminal(self):
        commands = [line.split()[0] for line in self.succeed("--help").stdout.splitlines() if line.startswith("  ")]
        self.assertIn("compare", commands)
        for command in ("", *(name for name in commands if name != "help"), "bake noise", "bake keys", "bake points"):
            for line in self.succeed(*command.split(), "--help").stdout.splitlines():
                self.assertLessEqual(len(line), 100, f"{command}: {line}")

    def test_help_of_many_options_has_headings(self):
        expected = {
            "render": {"Output": "aov", "Picture": "samples", "Camera": "eye", "Light": "lamp", "Scene": "ground",
                       "Time": "fps", "Parameters": "set", "Context": "threads", "General": "log-level"},
            "watch": {"Output": "stats", "Camera": "fov", "Parameters": "preset", "General": "help"},
            "view": {"Output": "layout", "Picture": "size", "Light": "sun-angle", "Parameters": "technique"},
            "bench": {"Measurement": "frames", "Time": "play", "Output": "output", "Context": "debug"},
            "compare": {"Measurement": "spp", "Camera": "orbit", "Cache of ray-traced shadows": "cache-size"},
            "truth": {"Measurement": "seed", "Output": "quiet", "Scene": "casters", "Time": "time"},
            "reproduce": {"Picture": "quick", "Camera": "target", "General": "help"},
            "plan render": {"Plan": "lead-in", "Output": "aov", "General": "log-level"},
        }
        if not has_viewer():
            del expected["view"]
        for command, options in expected.items():
            of, heading = {}, None
            for line in self.succeed(*command.split(), "--help").stdout.splitlines():
                if re.fullmatch(r"[A-Z][\w -]*:", line):
                    heading = line[:-1]
                elif found := re.match(r"  (?:-\w,)?--([\w-]+)", line):
                    of[found[1]] = heading
            for wanted, option in options.items():
                self.assertEqual(of[option], wanted, f"{command} --{option}")
            self.assertNotIn("Options", of.values(), command)
            self.assertEqual(list(of.values())[-1], "General", command)
        self.assertIn("\nOptions:\n", self.succeed("work", "--help").stdout)

    def test_every_choice_of_a_denoiser_is_listed(self):
        listed = {row["name"] for row in self.listed("denoisers")}
        params = self.listed("params")
        self.assertEqual(listed, set(next(row["choices"] for row in params if row["name"] == "denoiser")))

    def test_what_cannot_be_reached_is_told_as_what_it_is(self):
        (self.folder / "file").write_text("a file")
        (self.folder / "a").symlink_to("b")
        (self.folder / "b").symlink_to("a")
        places = [("file/x.glb", "Not a directory"), ("a", "Too many levels of symbolic links"),
                  ("x" * 300, "File name too long"), ("none.glb", "file not found")]
        for name, cause in places:
            for command in (("info", name), ("diff", name, name)):
                with self.subTest(command):
                    error = self.refuse(*command, cwd=self.folder)
                    self.assertIn(name, error)
                    self.assertTrue(error.endswith(cause), error)

    def test_a_folder_that_may_not_be_read_is_told(self):
        locked = self.folder / "locked"
        locked.mkdir()
        (locked / "x.glb").write_bytes(POSTS.read_bytes())
        self.folder.chmod(0o755)
        locked.chmod(0)
        self.addCleanup(locked.chmod, 0o755)
        someone = without_root()
        for command in (("info", locked / "x.glb"), ("diff", locked / "x.png", locked / "x.png")):
            error = self.refuse(*command, **someone)
            self.assertIn(str(command[1]), error)
            self.assertTrue(error.endswith("Permission denied"), error)

    def test_names_that_begin_with_a_dash(self):
        (self.folder / "-s.glb").write_bytes(POSTS.read_bytes())
        (self.folder / "-q.png").write_bytes(b"no picture")
        self.succeed("render", "-o", "x.png", *SMALL, "--quiet", "--", "-s.glb", cwd=self.folder)
        self.assertTrue((self.folder / "x.png").exists())
        for arguments in (["--", "-s.glb"], ["./-s.glb"]):
            self.assertIn("nodes", self.succeed("info", *arguments, cwd=self.folder).stdout)
        for arguments in (["info", "-s.glb"], ["render", "-s.glb", "-o", "y.png"], ["diff", "-q.png", "x.png"]):
            self.assertRegex(self.wrong(*arguments), r"'\./-[sq]\.\w+'")
        self.assertIn("unknown option '-t.glb'", self.wrong("info", "-t.glb"))
        self.assertIn("unexpected argument '--quiet'", self.wrong("info", "./-s.glb", "--", "--quiet"))

    def test_output_that_cannot_be_written_is_an_error(self):
        with open("/dev/full", "w") as full:
            result = subprocess.run([PROGRAM, "list", "params"], stdout=full, stderr=subprocess.PIPE, text=True)
        self.assertEqual(result.returncode, 1)
        self.assertTrue(result.stderr.startswith("error: "), result.stderr)

    def test_a_bare_file_name_and_a_negative_coordinate_are_fine(self):
        self.succeed("render", POSTS, "-o", "x.png", *SMALL, "--eye", "-1,2,3", "--target", "0,-0.5,0", "--quiet",
                     cwd=self.folder)
        self.assertTrue((self.folder / "x.png").exists())

    def test_log_level_quiet_silences_all_but_the_error(self):
        result = run("render", self.folder / "no.glb", "-o", self.folder / "x.png", "--log-level", "quiet")
        self.assertEqual((result.returncode, result.stdout), (1, ""))
        self.assertEqual(len(result.stderr.splitlines()), 1)


if __name__ == "__main__":
    main()
