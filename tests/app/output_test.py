"""Pictures on disk: the same bytes each time, on both backends; whole or not at all; AOVs, layers, metadata."""

import json
import os
import resource
import shutil
import signal
import subprocess
import time

from pictures import SMALL, SMALL_MAPS, read_exr, read_exr_header, read_png, scene
from support import PROGRAM, TestCase, main, run, wait_until_it_catches, without_root

POSTS = scene("posts")
AOVS = ("shadow", "depth", "normal", "albedo", "motion", "cascade", "blocker", "penumbra")


class Output(TestCase):
    def draw(self, name, *arguments, of=POSTS, size=SMALL):
        self.succeed("render", of, "-o", self.folder / name, *size, *SMALL_MAPS, "--quiet", *arguments)
        return (self.folder / name).read_bytes()

    def files(self):
        return sorted(str(path.relative_to(self.folder)) for path in self.folder.rglob("*"))

    def test_two_runs_give_the_same_bytes(self):
        names = ("x.png", "x.exr")
        first = [self.draw(name, "--aov", "shadow,depth") for name in names]
        time.sleep(1.1)  # a time stamp counts whole seconds
        self.assertEqual(first, [self.draw(name, "--aov", "shadow,depth") for name in names])

    def test_a_debug_context_gives_the_same_bytes_and_no_message(self):
        plain, debug = self.folder / "plain.png", self.folder / "debug.png"
        self.succeed("render", POSTS, "-o", plain, *SMALL, *SMALL_MAPS, "--quiet")
        result = self.succeed("render", POSTS, "-o", debug, *SMALL, *SMALL_MAPS, "--quiet", "--debug")
        self.assertEqual(result.stderr, "")
        self.assertEqual(debug.read_bytes(), plain.read_bytes())

    def test_backends_and_threads_give_the_same_bytes(self):
        for name in ("x.png", "x.exr"):
            with self.subTest(name):
                picture = self.draw(name, "--backend", "egl")
                self.assertEqual(picture, self.draw(name, "--backend", "osmesa"))
                self.assertEqual(picture, self.draw(name, "--threads", "1"))

    def test_summary_is_one_line(self):
        result = self.succeed("render", POSTS, "-o", self.folder / "x.png", *SMALL)
        self.assertRegex(result.stdout, r"^wrote \S+x\.png \(96×54, slices_denoised, \d+\.\d\d s\)\n$")
        self.assertEqual(result.stderr, "")

    def test_summary_names_the_aovs_that_were_asked_for(self):
        result = self.succeed("render", POSTS, "-o", self.folder / "x.exr", *SMALL, "--aov", "color, shadow ,depth")
        self.assertRegex(result.stdout, r"x\.exr with the AOVs color, shadow, depth \(")
        self.assertEqual(len(read_exr_header(self.folder / "x.exr")["channels"]), 5)

    def test_summaries_send_no_escape_sequences(self):
        drawn = (POSTS, *SMALL, *SMALL_MAPS)
        for name, command in (("a\x1b[31m.png", ("render", *drawn, "-o")),
                              ("b\x1b[31m.png", ("truth", POSTS, *SMALL, "--spp", "8", "--no-cache", "-o")),
                              ("c\x1b[31m.csv", ("bake", "points", "--count", "4", "-o")), ("d\x1b[31m", ("glsl",)),
                              ("e\x1b[31m", ("compare", *drawn, "--no-cost", "--technique", "hard", "--reference",
                                             "brute_force", "-o"))):
            said = self.succeed(*command, self.folder / name).stdout
            self.assertIn(name.replace("\x1b", " "), said)
            self.assertNotIn("\x1b", said)

    def test_missing_folders_are_made(self):
        self.draw("a/b/x.png")
        self.assertEqual(self.files(), ["a", "a/b", "a/b/x.png"])

    def test_pngs_of_aovs(self):
        self.draw("x.png", "--aov", "color," + ",".join(AOVS))
        self.assertEqual(self.files(), sorted(["x.png", *(f"x.{name}.png" for name in AOVS)]))
        for name in AOVS:
            with self.subTest(name):
                width, height, channels, rows = read_png(self.folder / f"x.{name}.png")
                self.assertEqual((width, height), (96, 54))
                self.assertEqual(channels, 3 if name in ("normal", "albedo", "motion", "cascade") else 1)
                if name != "motion":  # nothing moves
                    self.assertGreater(len(set(b"".join(rows))), 1)

    def test_layers_of_an_exr(self):
        self.draw("x.exr", "--aov", ",".join(AOVS))
        self.assertEqual(self.files(), ["x.exr"])
        rows = self.listed("aovs")
        channels = {row["name"]: row["channels"] for row in rows}
        wanted = [f"{name}.{channel}" for name in AOVS for channel in channels[name]] + ["R", "G", "B"]
        self.assertEqual(sorted(read_exr_header(self.folder / "x.exr")["channels"]), sorted(wanted))

    def test_every_aov_can_be_written(self):
        names = [row["name"] for row in self.listed("aovs")]
        self.assertLessEqual(set(AOVS) | {"color"}, set(names))
        self.draw("x.exr", "--aov", ",".join(names))
        self.draw("x.png", "--aov", ",".join(names))
        self.assertEqual(len(self.files()), 1 + len(names))

    def test_exr_tells_how_it_was_made(self):
        self.draw("x.exr", "--technique", "pcf", "--sun", "90,45", "--sun-angle", "1.5")
        header = read_exr_header(self.folder / "x.exr")
        self.assertEqual(header["penumbra:technique"], "pcf")
        self.assertEqual(header["penumbra:scene"], str(POSTS))
        self.assertEqual(header["penumbra:param.sun.angle"], "1.5")
        self.assertIn("Penumbra ", header["Software"])
        direction = [float(part) for part in header["penumbra:sun.to_light"].split()]
        for value, wanted in zip(direction, (0.70710678, 0.70710678, 0)):
            self.assertAlmostEqual(value, wanted, places=6)
        for row in self.listed("params"):
            self.assertIn(f"penumbra:param.{row['name']}", header)
        self.assertEqual(header.get("capDate", ""), "")

    def test_supersampling_averages_in_linear_light(self):
        large = ("--size", "96x54", "--exposure", "15")
        self.draw("large.png", size=large)
        self.draw("small.png", "--supersample", "2", size=("--size", "48x27", "--exposure", "15"))
        _, _, channels, small = read_png(self.folder / "small.png")
        _, _, _, drawn = read_png(self.folder / "large.png")
        for y, row in enumerate(small):
            for i, byte in enumerate(row):
                x, c = divmod(i, channels)
                block = [drawn[2 * y + j][(2 * x + k) * channels + c] for j in (0, 1) for k in (0, 1)]
                self.assertAlmostEqual(byte, encode(sum(map(decode, block)) / 4), delta=0.51)

    def test_samples_smooth_the_colour_picture_alone(self):
        names = [row["name"] for row in self.listed("aovs") if row["name"] != "color"]
        aovs = ("--aov", ",".join(names))
        for folder, samples in (("one", ["--samples", "1"]), ("usual", []), ("again", []),
                                ("four", ["--samples", "4"])):
            self.draw(f"{folder}/x.png", *aovs, *samples)

        def file(folder, name):
            return (self.folder / folder / name).read_bytes()

        self.assertNotEqual(file("one", "x.png"), file("usual", "x.png"))
        self.assertEqual(file("usual", "x.png"), file("again", "x.png"), "the same bytes twice")
        self.assertEqual(file("usual", "x.png"), file("four", "x.png"), "the default")
        for name in names:
            self.assertEqual(file("one", f"x.{name}.png"), file("usual", f"x.{name}.png"), name)

    def test_aovs_of_all_samples(self):
        rows = [row["name"] for row in self.listed("aovs")]
        aovs = ("--aov", ",".join(rows), "--samples", "4")
        for name, which in (("unsaid", []), ("first", ["first"]), ("all", ["all"]), ("again", ["all"])):
            self.draw(f"{name}/x.exr", *aovs, *(["--aov-samples", *which] if which else []))
        unsaid, first, means = (read_exr(self.folder / name / "x.exr") for name in ("unsaid", "first", "all"))
        self.assertEqual(unsaid, first)
        self.assertEqual((self.folder / "all/x.exr").read_bytes(), (self.folder / "again/x.exr").read_bytes())
        header = read_exr_header(self.folder / "all/x.exr")
        self.assertEqual((header["penumbra:samples"], header["penumbra:aov_samples"]), ("4", "all"))
        averaged = {name.split(".")[0] for name in means if means[name] != first[name]}
        self.assertEqual(averaged, {"shadow", "albedo", "material", "blocker", "penumbra"})  # nothing emits light
        self.assertLessEqual({value for row in means["cascade.V"] for value in row}, {-1, 0, 1, 2, 3})
        self.draw("p.png", *aovs, "--aov-samples", "all")
        self.draw("q.png", *aovs)
        self.assertNotEqual(*((self.folder / f"{name}.shadow.png").read_bytes() for name in "pq"))
        self.assertEqual(*((self.folder / f"{name}.depth.png").read_bytes() for name in "pq"))

    def test_samples_leave_the_frames_of_a_sequence_their_history(self):
        remembers = ("--technique", "thesis", "--frames", "0:3", "--aov", "shadow,history", "--quiet")
        for samples in ("1", "5"):
            self.succeed("render", scene("moving"), "-o", self.folder / samples / "x.png", *SMALL, *SMALL_MAPS, *remembers,
                         "--samples", samples)
        for frame in range(4):
            for aov in ("", ".shadow", ".history"):
                one, five = ((self.folder / samples / f"x_{frame:04}{aov}.png").read_bytes() for samples in "15")
                self.assertEqual(one == five, aov != "", f"frame {frame}{aov}")

    def test_supersampled_aovs_hold_no_value_that_means_nothing(self):
        names = [row["name"] for row in self.listed("aovs")]
        aovs = ("--aov", ",".join(names), "--exposure", "15")
        # Sky, edges and shadows from above the posts' side.
        view = ("--eye", "0,4,14", "--target", "0,2,0", "--fov", "50")
        self.draw("large.exr", *aovs, *view, size=("--size", "96x54"))
        self.draw("small.exr", *aovs, *view, "--supersample", "2", size=("--size", "48x27"))
        large, small = (read_exr(self.folder / f"{name}.exr") for name in ("large", "small"))
        self.assertEqual(set(large), set(small))
        mixed = {name: 0 for name in large}
        for name, rows in small.items():
            layer = name.split(".")[0]
            for y, row in enumerate(rows):
                for x, value in enumerate(row):
                    block = [large[name][2 * y + j][2 * x + i] for j in (0, 1) for i in (0, 1)]
                    mixed[name] += len(set(block)) > 1
                    if layer in ("depth", "position", "normal", "geometric_normal", "cascade", "under_texel", "history"):
                        self.assertEqual(value, block[3], name)
                    elif layer in ("motion", "texel"):
                        self.assertEqual(value, block[3] / 2)
                    else:
                        valid = [v for v in block if v != 0] if layer in ("blocker", "penumbra") else block
                        wanted = sum(valid) / max(len(valid), 1)
                        self.assertAlmostEqual(value, wanted, delta=1e-5 * abs(wanted), msg=name)
        for name in ("depth.Z", "cascade.V", "blocker.V", "penumbra.V", "shadow.V"):
            self.assertGreater(mixed[name], 0, name)

    def test_the_eye_sees_what_it_is_aimed_at(self):
        # From straight above, the ground fills the picture and faces the camera.
        self.draw("x.png", "--eye", "0,30,0", "--target", "0,0,0", "--fov", "40", "--aov", "normal")
        rows = read_png(self.folder / "x.normal.png")[3]
        up = sum(rows[y][3 * x + 1] >= 254 for y in range(54) for x in range(96))
        self.assertGreater(up, 54 * 96 * 0.9)

    def test_failure_leaves_nothing(self):
        junk = self.folder / "junk.glb"
        junk.write_bytes(bytes(range(256)) * 16)
        for of in (self.folder / "no.glb", self.folder, junk, "/dev/null", "/bin/sh"):
            with self.subTest(of):
                self.refuse("render", of, "-o", self.folder / "new" / "x.png")
        self.refuse("render", POSTS, "-o", self.folder / "new" / "x.png", "--egl-device", "200")
        self.refuse("render", POSTS, "-o", self.folder / "new" / "x.jpg", code=2)
        self.assertEqual(self.files(), ["junk.glb"])

    def test_failure_keeps_the_old_picture(self):
        (self.folder / "x.png").write_text("old")
        self.refuse("render", self.folder / "no.glb", "-o", self.folder / "x.png")
        self.assertEqual((self.folder / "x.png").read_text(), "old")

    def test_places_that_cannot_be_written_are_found_first(self):
        (self.folder / "file").write_text("a file")
        for option in ("-o", "--stats", "--save-preset"):
            name = "x.toml" if option == "--save-preset" else "x.png"
            for place in (f"/proc/none/{name}", self.folder / "file" / name, self.folder):
                with self.subTest(f"{option} {place}"):
                    others = [] if option == "-o" else ["-o", self.folder / "x.png"]
                    # The scene does not exist either: the error shows which check comes first.
                    error = self.refuse("render", "none.glb", option, place, *others,
                                        code=2 if option == "-o" and place == self.folder else 1)
                    self.assertNotIn("none.glb", error)
        self.assertEqual(self.files(), ["file"])

    def test_a_read_only_folder(self):
        self.folder.chmod(0o555)
        self.addCleanup(self.folder.chmod, 0o755)
        self.assertIn("x.png", self.refuse("render", POSTS, "-o", self.folder / "x.png", **without_root()))

    def test_signals_leave_nothing(self):
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            with self.subTest(number):
                process = subprocess.Popen([PROGRAM, "render", POSTS, "-o", self.folder / "x_%d.png", "--frames",
                                            "0:9999", "--size", "64x36", *SMALL_MAPS], stdout=subprocess.DEVNULL)
                deadline = time.monotonic() + 120
                while not (self.folder / "x_1.png").exists() and time.monotonic() < deadline:
                    time.sleep(0.02)
                self.assertTrue((self.folder / "x_1.png").exists())
                process.send_signal(number)
                self.assertEqual(process.wait(timeout=60), 128 + number)
                self.assertEqual([name for name in self.files() if not name.startswith("x_")], [])
                for path in self.folder.iterdir():
                    read_png(path)  # each is whole
                    path.unlink()

    def test_a_signal_that_is_ignored_stays_ignored(self):
        """As SIGINT in programs that a script starts in the background, and SIGHUP in those of nohup."""
        for number in (signal.SIGINT, signal.SIGHUP):
            process = subprocess.Popen([PROGRAM, "render", POSTS, "-o", self.folder / "x_%d.png", "--frames", "0:1",
                                        *SMALL, *SMALL_MAPS], stdout=subprocess.DEVNULL,
                                       preexec_fn=lambda ignored=number: signal.signal(ignored, signal.SIG_IGN))
            wait_until_it_catches(signal.SIGTERM, process)
            process.send_signal(number)
            self.assertEqual(process.wait(timeout=60), 0)

    def test_a_limit_of_file_sizes_is_an_error_and_leaves_nothing(self):
        def few_bytes():
            resource.setrlimit(resource.RLIMIT_FSIZE, (512, 512))

        for name in ("a.png", "a.exr"):
            error = self.refuse("render", POSTS, "-o", self.folder / name, *SMALL, preexec_fn=few_bytes)
            self.assertRegex(error, f"cannot write '.*{name}': File too large")
            self.assertEqual(list(self.folder.iterdir()), [])
        with (self.folder / "params.json").open("w") as listing:
            process = subprocess.run([PROGRAM, "list", "params", "--json"], stdout=listing, stderr=subprocess.PIPE,
                                     preexec_fn=few_bytes, text=True, check=False)
        self.assertEqual((process.returncode, process.stderr), (1, "error: cannot write to standard output\n"))

    def test_links_stay_and_what_they_lead_to_is_written(self):
        (self.folder / "real").mkdir()
        for name in ("x.png", "s.json", "p.toml"):
            (self.folder / "real" / name).write_text("old")
            (self.folder / "real" / name).chmod(0o640)
            (self.folder / name).symlink_to(f"real/{name}")
        self.draw("x.png", "--stats", self.folder / "s.json", "--save-preset", self.folder / "p.toml")
        for name in ("x.png", "s.json", "p.toml"):
            self.assertTrue((self.folder / name).is_symlink(), name)
            self.assertEqual((self.folder / "real" / name).stat().st_mode & 0o777, 0o640, name)
        read_png(self.folder / "real" / "x.png")
        json.loads((self.folder / "real" / "s.json").read_text())
        self.assertEqual(len(self.files()), 7)

    def test_no_result_goes_through_a_link_to_the_scene(self):
        copy = self.folder / "s.glb"
        shutil.copy(POSTS, copy)
        before = copy.read_bytes()
        for name in ("x.png", "x.depth.png", "x_0001.png", "s.json", "p.toml"):
            (self.folder / name).symlink_to("s.glb")
        for results in (("-o", "x.png"), ("-o", "x_#.png", "--frames", "0:1"), ("-o", "y.png", "--stats", "s.json"),
                        ("-o", "x.png", "--aov", "depth"), ("-o", "y.png", "--save-preset", "p.toml")):
            arguments = [result.replace("x_#", "x_####") for result in results]
            error = self.refuse("render", copy, *arguments, *SMALL, code=2, cwd=self.folder)
            self.assertIn("overwrite the scene", error)
        self.assertEqual(copy.read_bytes(), before)

    def test_what_a_link_to_an_open_file_leads_to_is_written(self):
        # As /dev/stdout, which leads to /proc/self/fd/1: replacing it would take the machine's away.
        self.draw("direct.png")
        direct = (self.folder / "direct.png").read_bytes()
        for option, name in (("-o", "x.png"), ("--stats", "s.json"), ("--save-preset", "p.toml")):
            link = self.folder / name
            link.symlink_to("/proc/self/fd/1")
            others = [] if option == "-o" else ["-o", self.folder / "y.png"]
            written = []
            for output in (subprocess.PIPE, (self.folder / "stdout.txt").open("wb")):
                result = subprocess.run([PROGRAM, "render", POSTS, option, link, *others, *SMALL, *SMALL_MAPS],
                                        stdout=output, stderr=subprocess.PIPE, check=False)
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertRegex(result.stderr.decode(), r"^wrote \S+", "the summary is elsewhere")
                written.append(result.stdout or (self.folder / "stdout.txt").read_bytes())
                self.assertEqual(os.readlink(link), "/proc/self/fd/1")
            if option == "-o":
                self.assertEqual(written, [direct, direct])
            elif option == "--stats":
                self.assertEqual([json.loads(text)["width"] for text in written], [96, 96])
            else:
                self.assertEqual(*written)
            link.unlink()

    def test_shaders_are_written_all_or_none(self):
        def few_bytes():
            resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))

        error = self.refuse("glsl", self.folder / "a" / "b", preexec_fn=few_bytes)
        self.assertIn("File too large", error)
        self.assertEqual(self.files(), [])
        self.succeed("glsl", self.folder / "a" / "b")
        before = {path: path.read_bytes() for path in self.folder.rglob("*") if path.is_file()}
        for path in before:
            path.write_text("changed")
        self.refuse("glsl", self.folder / "a" / "b", "--force", preexec_fn=few_bytes)
        self.assertEqual({path.read_text() for path in before}, {"changed"})
        self.succeed("glsl", self.folder / "a" / "b", "--force")
        self.assertEqual({path: path.read_bytes() for path in self.folder.rglob("*") if path.is_file()}, before)

    def limited(self, limit, most, *arguments, **options):
        """Runs the program under a limit of the system."""
        return run(*arguments, preexec_fn=lambda: resource.setrlimit(limit, (most, most)), **options)

    def test_too_little_memory_is_a_sentence(self):
        # 500 MiB hold the program and its libraries; then come the driver, LLVM and the picture.
        seen = set()
        for mebibytes in (550, 700, 850, 1100):
            with self.subTest(mebibytes):
                result = self.limited(resource.RLIMIT_AS, mebibytes << 20, "render", POSTS, "-o", self.folder / "x.png",
                                      "--size", "640x360", "--quiet")
                if result.returncode == 127:
                    continue  # not even the libraries fit: the loader says so
                self.assertIn(result.returncode, (0, 1), result.stderr)
                if result.returncode == 1:
                    self.assertRegex(result.stderr, r"^error: [^\n]*memory[^\n]*\n$")
                    self.assertNotIn("internal error", result.stderr)
                    self.assertEqual(self.files(), [])
                seen.add(result.returncode)
        self.assertIn(1, seen)

    def test_too_few_threads_are_a_sentence(self):
        if os.geteuid() != 0:
            self.skipTest("this user's other processes would count too")
        self.folder.chmod(0o777)
        someone = without_root()
        for most in (6, 7):  # libraries start four before the program does
            with self.subTest(most):
                result = self.limited(resource.RLIMIT_NPROC, most, "render", POSTS, "-o", self.folder / "x.png", *SMALL,
                                      "--threads", "8", **someone)
                self.assertEqual(result.returncode, 1)
                self.assertRegex(result.stderr, r"^error: [^\n]*threads[^\n]*ulimit -u[^\n]*\n$")
                self.assertEqual(self.files(), [])

    def test_a_picture_does_not_overwrite_the_scene(self):
        for name, output in (("my.png", "my.png"), ("my.png", "sub/../my.png"), ("my_0001.png", "my_####.png")):
            copy = self.folder / name
            shutil.copy(POSTS, copy)
            before = copy.read_bytes()
            frames = ("--frames", "0:1") if "#" in output else ()
            error = self.refuse("render", copy, "-o", self.folder / output, *SMALL, *frames, code=2)
            self.assertIn("overwrite the scene", error)
            self.assertEqual(copy.read_bytes(), before)

    def test_no_result_overwrites_a_file_that_the_scene_names(self):
        names = ("a b.bin", "color.png", "p.toml")
        buffers = [{"uri": uri, "byteLength": 4} for uri in ("a%20b.bin", "p.toml")]
        gltf = {"asset": {"version": "2.0"}, "buffers": buffers}
        gltf["images"] = [{"uri": "color.png"}]
        (self.folder / "s.gltf").write_text(json.dumps(gltf))
        for name in names:
            (self.folder / name).write_bytes(b"data")
        command = ("render", self.folder / "s.gltf", *SMALL)
        stats = ("-o", self.folder / "x.png", "--stats", self.folder / names[0])
        preset = ("-o", self.folder / "x.png", "--save-preset", self.folder / names[2])
        for results in (("-o", self.folder / names[1]), stats, preset):
            self.assertIn("overwrite the scene's file", self.refuse(*command, *results, code=2))
        for name in names:
            self.assertEqual((self.folder / name).read_bytes(), b"data")
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), sorted((*names, "s.gltf")))

    def test_a_closed_stderr_does_not_change_the_exit_code(self):
        failed = subprocess.run(f"'{PROGRAM}' info nosuch.glb 2>&-", shell=True, check=False)
        self.assertEqual(failed.returncode, 1)
        for place in (">&-", ">/dev/full"):  # of a command that warns
            picture = self.folder / "x.png"
            drawn = subprocess.run(f"'{PROGRAM}' render '{POSTS}' -o '{picture}' --size 64x36 --fps 10 -q 2{place}", shell=True,
                                   check=False)
            self.assertEqual(drawn.returncode, 0, place)
            picture.unlink()


def decode(byte):
    value = byte / 255
    return value / 12.92 if value <= 0.04045 else ((value + 0.055) / 1.055) ** 2.4


def encode(value):
    return 255 * (12.92 * value if value <= 0.0031308 else 1.055 * value ** (1 / 2.4) - 0.055)


if __name__ == "__main__":
    main()
