"""penumbra compare: its table, CSV and JSON agree; what can't be done is told before anything is drawn."""

import csv
import json
import re
import resource
import signal
import subprocess
import time

from pictures import SMALL, SMALL_MAPS, scene
from support import PROGRAM, TestCase, main, wait_until_it_catches

POSTS = scene("posts")
NAMES = ["hard", "pcf", "pcss:pcss.filter_taps=4,pcss.blocker_taps=4"]
BRUTE = ("--reference", "brute_force", "--technique", ",".join(NAMES))
COSTS = ("cost_median_ms", "cost_min_ms", "cost_max_ms")


def rows_of(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


class Compare(TestCase):
    def compare(self, *arguments, of=(POSTS,), into="report", size=SMALL, maps=SMALL_MAPS, **options):
        result = self.succeed("compare", *of, "-o", self.folder / into, *size, *maps, "--no-cache", *arguments, **options)
        folder = self.folder / into
        return result.stdout, rows_of(folder / "results.csv"), json.loads((folder / "results.json").read_text())

    def files(self):
        return sorted(path.relative_to(self.folder).as_posix() for path in self.folder.rglob("*"))

    def test_three_files_and_no_others(self):
        self.compare(*BRUTE)
        self.assertEqual(self.files(), ["report", "report/index.html", "report/results.csv", "report/results.json"])

    def test_the_table_csv_and_json_agree(self):
        table, rows, data = self.compare(*BRUTE)
        lines = table.splitlines()
        self.assertEqual(lines[-1], f"wrote {self.folder / 'report' / 'index.html'}")
        self.assertEqual([line.split()[0] for line in lines[1:-1]], NAMES)
        self.assertEqual([row["technique"] for row in rows], NAMES)
        techniques = data["scenes"][0]["techniques"]
        self.assertEqual([technique["label"] for technique in techniques], NAMES)
        for line, row, technique in zip(lines[1:-1], rows, techniques):
            cells = re.split(r"\s{2,}", line)
            for cell, name, decimals in ((cells[1], "cost_median_ms", 1), (cells[3], "psnr_penumbra", 2),
                                         (cells[4], "psnr", 2), (cells[5], "bias", 4), (cells[6], "flip", 4)):
                self.assertAlmostEqual(float(cell), float(row[name]), delta=0.51 * 10**-decimals, msg=name)
            self.assertEqual(row["cost_frames"], "3")
            costs = {f"cost_{name}": value for name, value in technique["cost"].items()}
            for name, value in {**technique["figures"], **costs}.items():
                if name in row:
                    self.assertEqual(row[name], "" if value is None else f"{value:.6g}", name)
            self.assertEqual(int(row["shadow_bytes"]), technique["shadow_bytes"])

    def test_says_whether_maps_were_drawn_anew_or_kept(self):
        contenders = ("--reference", "brute_force", "--technique")
        for names, more, said in (("pcss,hard", (), "drawn anew in every frame"),
                                  ("pcss,hard", ("--set", "maps.keep=on"), "kept where nothing moved"),
                                  ("pcss:maps.keep=on,hard", (), "kept or drawn anew as maps.keep says of each")):
            data = self.compare(*contenders, names, *more)[2]
            self.assertEqual(data["maps"], said)

    def test_a_number_of_rays_that_is_set_counts_as_for_truth(self):
        data = self.compare("--technique", "hard", "--spp", "8", "--set", "truth.samples=16", "--no-cost")[2]
        self.assertEqual(data["reference"]["changed_params"]["truth.samples"], 16)

    def page(self, *arguments, of=POSTS):
        self.compare("--technique", "hard", "--no-cost", *arguments, of=(of,))
        return (self.folder / "report" / "index.html").read_text(encoding="utf-8")

    def test_the_page_names_as_many_rays_as_were_traced(self):
        self.assertIn("against the ray-traced truth, 16 rays a pixel.", self.page("--spp", "9"))
        self.assertIn("against the ray-traced truth, 64 rays a pixel, or as many as a standard error of 0.1 takes.",
                      self.page("--spp", "8", "--set", "truth.error=0.1"))

    def test_the_page_tells_of_an_orbit_where_there_is_one(self):
        moving = ("--reference", "brute_force", "--orbit", "5", "--frames")
        self.assertIn("2 frames, 24 a second, orbit of 5° a frame with a cut", self.page(*moving, "0:1"))
        still = self.page(*moving, "0:0")
        self.assertNotIn("orbit of", still)
        self.assertIn("frame 0<", still)

    def test_the_page_speaks_of_the_lights_that_there_are(self):
        def page(*arguments, of):
            return self.page("--spp", "8", *arguments, of=of)

        sun = page(of=POSTS)
        self.assertRegex(sun, r"where the light can shine: \d+ of \d+ pixels\.")
        self.assertIn("0.53° disc", sun)
        lamp = page("--no-sun", "--lamp", "1,3,0", "--lights", "none", of=POSTS)
        self.assertNotIn("° disc", lamp)
        self.assertRegex(lamp, r"where the light can shine: \d+ of \d+ pixels\.")
        both = page(of=scene("gallery"))
        self.assertIn("° disc", both)
        self.assertRegex(both, r"where the light can shine: \d+ of \d+ pixels of the masks of 4 lights\.")

    def test_the_memory_of_references_is_that_of_all_lights(self):
        # Within the limit for one light, over it for the four of the scene.
        arguments = ("compare", scene("gallery"), "--technique", "hard", "--frames", "0:7", "--size", "4096x4096")
        for command in (arguments, ("plan", *arguments)):
            error = self.refuse(*command, "-o", self.folder / "out.json")
            self.assertIn("gallery.glb': 8 reference pictures of 4096x4096 for each of 4 lights are over the limit", error)
        self.assertEqual(self.files(), [])

    def test_parameters_of_one_technique_are_its_own(self):
        _, _, data = self.compare(*BRUTE, "--set", "sun.angle=3", maps=())
        hard, pcf, pcss = (technique["changed_params"] for technique in data["scenes"][0]["techniques"])
        self.assertEqual(pcss, {"sun.angle": 3, "maps.keep": False, "pcss.filter_taps": 4, "pcss.blocker_taps": 4})
        self.assertEqual((hard["sun.angle"], hard["technique"]), (3, "hard"))
        self.assertNotIn("pcss.filter_taps", {**hard, **pcf})
        reference = data["reference"]["changed_params"]
        self.assertEqual((reference["sun.angle"], reference["technique"]), (3, "brute_force"))

    def test_a_reference_is_not_filtered(self):
        _, _, data = self.compare(*BRUTE, "--set", "history.reuse=true", "--set", "filter.visibility=box")
        self.assertEqual(data["reference"]["changed_params"]["denoiser"], "none")
        self.assertEqual(data["scenes"][0]["techniques"][0]["changed_params"]["filter.visibility"], "box")

    def test_a_reference_is_of_all_pixels(self):
        _, _, data = self.compare(*BRUTE, "--set", "mask.scale=4")
        self.assertNotIn("mask.scale", data["reference"]["changed_params"])
        self.assertEqual(data["scenes"][0]["techniques"][1]["changed_params"]["mask.scale"], 4)

    def test_two_runs_give_the_same_figures(self):
        first, second = (self.compare(*BRUTE, into=name) for name in ("a", "b"))
        for rows in (first[1], second[1]):
            for row in rows:
                for cost in COSTS:
                    row.pop(cost)
        self.assertEqual(first[1], second[1])
        for data in (first[2], second[2]):
            data.pop("command")
            for technique in data["scenes"][0]["techniques"]:
                technique.pop("cost")
        self.assertEqual(first[2], second[2])

    def test_figures_do_not_depend_on_what_else_is_compared(self):
        thesis = ("--set", "sun.angle=4")
        together = self.compare("--reference", "brute_force", "--technique", "pcf,thesis", *thesis, into="a")[2]
        alone = self.compare("--reference", "brute_force", "--technique", "thesis", *thesis, into="b")[2]
        a, b = together["scenes"][0]["techniques"][1], alone["scenes"][0]["techniques"][0]
        self.assertEqual((a["figures"], a["shadow_bytes"]), (b["figures"], b["shadow_bytes"]))

    def test_what_equals_the_reference_has_no_error(self):
        seed = self.compare(*BRUTE, into="seed")[2]["reference"]["changed_params"]["sampling.seed"]
        same = f"brute_force:sampling.seed={seed}"
        table, rows, data = self.compare("--reference", "brute_force", "--technique", f"{same},hard")
        self.assertEqual((rows[0]["psnr_penumbra"], float(rows[0]["bias"])), ("inf", 0))
        self.assertEqual(data["scenes"][0]["techniques"][0]["figures"]["psnr_penumbra"], "inf")
        self.assertRegex(table, same + r" .* inf ")
        self.assertLess(float(rows[1]["psnr_penumbra"]), 40)

    def test_a_sampled_reference_has_other_points_than_what_is_measured(self):
        for seed in ("0", "40000"):
            _, rows, _ = self.compare("--reference", "brute_force", "--technique", "brute_force", "--set",
                                      f"sampling.seed={seed}")
            self.assertNotEqual(rows[0]["psnr_penumbra"], "inf")
            self.assertGreater(float(rows[0]["psnr_penumbra"]), 40)

    def test_values_that_are_not_finite_are_counted_and_told(self):
        shader = self.folder / "glsl" / "shadow" / "techniques" / "none.glsl"
        shader.parent.mkdir(parents=True)
        shader.write_text("""#include "shadow/light.glsl"
float read_radius(Receiver receiver, Light light) { return 0.0; }
Visibility visibility(Receiver receiver, Light light) { return Visibility(uintBitsToFloat(0x7fc00000u), 0.0, 0.0, true, false); }
""")
        arguments = ("--reference", "brute_force", "--technique", "none,hard", "--glsl", self.folder / "glsl", "--no-cost")
        counts = []
        for more in ((), ("--frames", "0:1")):
            command = ("compare", POSTS, "-o", self.folder / "report", *SMALL, *SMALL_MAPS, *arguments, *more)
            result = self.succeed(*command)
            rows = rows_of(self.folder / "report" / "results.csv")
            data = json.loads((self.folder / "report" / "results.json").read_text())["scenes"][0]
            counts.append(int(rows[0]["not_finite"]))
            self.assertEqual(list(rows[0])[-1], "not_finite")
            self.assertEqual([int(row["not_finite"]) for row in rows],
                             [technique["figures"]["not_finite"] for technique in data["techniques"]])
            self.assertEqual(rows[1]["not_finite"], "0")
            told = f"'none' gives values that are not finite: {counts[-1]}; each counts as an error of 1"
            self.assertEqual(result.stderr, f"warning: '{POSTS}': {told}\n")
            self.assertIn(told.replace("'", "&#39;"), (self.folder / "report" / "index.html").read_text())
        self.assertEqual(counts, [data["receivers"], 2 * data["receivers"]])

    def test_penumbrae_without_a_width_are_told(self):
        table, rows, data = self.compare("--reference", "brute_force", "--technique", "none,brute_force", "--set",
                                         "sun.angle=4")
        lost = [float(row["penumbra_width_lost"]) for row in rows]
        self.assertEqual(lost[0], 1)  # all lit
        self.assertLess(lost[1], 0.2)
        self.assertEqual(rows[0]["penumbra_width_error"], "")
        self.assertEqual(data["scenes"][0]["techniques"][0]["figures"]["penumbra_width_lost"], 1)
        self.assertRegex(table, r"none .* 100\.0 ")
        self.assertIn("Width lost", (self.folder / "report" / "index.html").read_text())

    def test_a_run_can_be_repeated_from_what_the_report_says(self):
        _, rows, data = self.compare(*BRUTE)
        self.assertRegex(data["version"], r"^Penumbra \d")
        self.assertTrue(data["commit"])
        self.assertTrue(data["command"].startswith("penumbra compare "))
        self.assertIn("--reference brute_force", data["command"])
        camera, (sun,) = (data["scenes"][0][name] for name in ("camera", "lights"))
        page = (self.folder / "report" / "index.html").read_text()
        self.assertIn(data["commit"], page)
        self.assertIn("--sun</span>=" + f"{sun['azimuth_degrees']:g}", page)
        view = []
        for name in ("eye", "target"):
            view += [f"--{name}={','.join(map(str, camera[name]))}"]
        again = self.compare(*BRUTE, *view, "--fov", camera["fov_y_degrees"], f"--sun={sun['azimuth_degrees']},{sun['elevation_degrees']}",
                             into="again")
        for row, other in zip(rows, again[1]):
            self.assertAlmostEqual(float(row["psnr"]), float(other["psnr"]), delta=0.1)
        length = sum(value * value for value in sun["to_light"])
        self.assertAlmostEqual(length, 1, places=4)

    def test_a_picture_that_the_sun_does_not_reach_is_told(self):
        arguments = ("--ground", "off", "--eye", "0,50,0", "--target", "0,60,0")
        result = self.succeed("compare", POSTS, "-o", self.folder / "sky", *SMALL, *SMALL_MAPS, *BRUTE, *arguments)
        self.assertEqual(len(result.stderr.splitlines()), 1)
        self.assertIn("nothing to measure", result.stderr)
        self.assertIn(POSTS.name, result.stderr)

    def test_better_techniques_have_better_figures_against_the_truth(self):
        _, rows, data = self.compare("--technique", "none,hard,pcss,brute_force", "--spp", "64", "--set", "sun.angle=4")
        self.assertEqual(data["reference"]["changed_params"]["truth.samples"], 64)
        psnr = [float(row["psnr_penumbra"]) for row in rows]
        self.assertEqual(psnr, sorted(psnr))
        self.assertGreater(float(rows[0]["bias"]), 0.05)  # all lit
        self.assertEqual(int(data["scenes"][0]["pixels"]), 96 * 54)
        self.assertGreater(data["scenes"][0]["receivers"], 96 * 54 / 4)

    def test_surfaces_that_the_sun_does_not_reach_are_no_receivers(self):
        arguments = ("--reference", "brute_force", "--technique", "hard", "--ground", "off")
        noon = self.compare(*arguments, "--sun", "0,80")[2]["scenes"][0]["receivers"]
        below = self.compare(*arguments, "--sun", "0,-80")[2]["scenes"][0]
        self.assertLess(below["receivers"], noon)

    def test_several_scenes(self):
        scenes = (POSTS, scene("steps"))
        table, rows, data = self.compare("--reference", "brute_force", "--technique", "hard,pcf", of=scenes)
        self.assertEqual([row["scene"] for row in rows], [str(scenes[0])] * 2 + [str(scenes[1])] * 2)
        self.assertEqual([part["scene"] for part in data["scenes"]], [str(path) for path in scenes])
        for path in scenes:
            self.assertIn(f"{path}\n", table)

    def test_a_sequence_has_flicker_and_a_picture_has_none(self):
        page = self.folder / "report" / "index.html"
        _, rows, _ = self.compare("--reference", "brute_force", "--technique", "hard")
        self.assertEqual(rows[0]["flicker"], "")
        self.assertIn("The figures are of these pictures.", page.read_text())
        _, rows, data = self.compare("--reference", "brute_force", "--technique", "hard,thesis", "--frames", "0:5",
                                     of=(scene("moving"),))
        self.assertEqual(data["frames"], 6)
        self.assertNotIn("The figures are of these pictures.", page.read_text())
        self.assertIn("The figures are of all frames, these pictures of the last.", page.read_text())
        for row in rows:
            self.assertGreater(float(row["flicker"]), 0)

    def test_an_orbit_moves_the_camera_and_cuts(self):
        arguments = ("--reference", "brute_force", "--technique", "thesis", "--frames", "0:5")
        _, still, at_rest = self.compare(*arguments)
        _, moving, data = self.compare(*arguments, "--orbit", "2", "--cut-at", "4")
        self.assertNotEqual(still[0]["psnr"], moving[0]["psnr"])
        self.assertEqual(data["scenes"][0]["receivers"], at_rest["scenes"][0]["receivers"])  # back where it began
        recoveries = data["scenes"][0]["techniques"][0]["figures"]["recoveries"]
        self.assertEqual([recovery["frame"] for recovery in recoveries], [4])
        _, _, data = self.compare(*arguments, "--orbit", "2")
        self.assertEqual(data["scenes"][0]["techniques"][0]["figures"]["recoveries"][0]["frame"], 3)
        _, _, data = self.compare(*arguments[:4], "--frames", "10:13", "--orbit", "2")
        self.assertEqual(data["scenes"][0]["techniques"][0]["figures"]["recoveries"][0]["frame"], 12)

    def test_quiet_prints_nothing(self):
        result = self.succeed("compare", POSTS, "-o", self.folder / "x", *SMALL, *SMALL_MAPS, *BRUTE, "--quiet")
        self.assertEqual((result.stdout, result.stderr), ("", ""))


class Refusals(TestCase):
    def refused(self, *arguments, code=2, of=POSTS):
        line = self.refuse("compare", of, "-o", self.folder / "report", *arguments, code=code)
        self.assertEqual(list(self.folder.iterdir()), [], line)
        return line

    def test_unknown_names(self):
        self.assertIn("did you mean 'pcss'", self.refused("--technique", "hard,pcsss"))
        self.assertIn("did you mean 'pcss.filter_taps'", self.refused("--technique", "pcss:pcss.filter_tap=4"))
        self.assertIn("did you mean 'truth'", self.refused("--technique", "pcss", "--reference", "thruth"))

    def test_what_is_wrong_is_told_before_files_are_looked_at(self):
        nowhere = self.folder / "nowhere"
        for arguments in (("--technique", "pcsss"), ("--technique", "pcss:pcss.filter_tap=4"), ("--technique", "hard,"),
                          ("--technique", "pcss", "--set", "pcss.filter_taps=-1"), ("--technique", "truth"),
                          ("--technique", "pcss", "--sun-angle", "x"), ("--technique", "pcss:sun.angle=2"),
                          ("--technique", "pcss", "--orbit", "2"), ("--technique", "pcss", "--exposure", "x"),
                          ("--technique", "pcss", "--cache", "x", "--no-cache"),
                          ("--technique", "pcss", "--cache", "x", "--reference", "brute_force")):
            self.refused(*arguments, "--preset", nowhere / "none.toml", "--glsl", nowhere, of=nowhere / "none.glb")
        self.assertIn("empty", self.refuse("compare", POSTS, "-o", "", "--technique", "pcss", code=2))

    def test_a_cache_is_for_what_is_traced(self):
        arguments = ("--reference", "brute_force", "--cache", self.folder / "kept", *SMALL, *SMALL_MAPS)
        self.assertIn("--cache", self.refused("--technique", "hard", *arguments))
        self.succeed("compare", POSTS, "-o", self.folder / "report", "--technique", "truth:truth.samples=8", *arguments)
        self.assertEqual(len([path for path in (self.folder / "kept").rglob("*") if path.is_file()]), 1)

    def test_the_size_of_a_cache(self):
        folder = self.folder / "cache"
        truth = ("--technique", "hard", "--spp", "8", "--no-cost", "--cache", folder)
        for size, kept in (("1KiB", 0), ("1MiB", 1)):
            self.succeed("compare", POSTS, "-o", self.folder / "report", *SMALL, *SMALL_MAPS, *truth, "--cache-size", size)
            self.assertEqual(len(list(folder.glob("*.truth"))), kept)
        for size in ("", "0", "1.5GiB", "-3", "many", "99999999999999999999"):
            self.refuse("compare", POSTS, "-o", self.folder / "x", *truth, "--cache-size", size, code=2)
        self.assertIn("exclude each other", self.refuse("compare", POSTS, "-o", self.folder / "x", *truth[:-2], "--no-cache",
                                                        "--cache-size", "1GiB", code=2))

    def test_values_out_of_range(self):
        self.assertIn("pcss.filter_taps", self.refused("--technique", "pcss:pcss.filter_taps=-1"))

    def test_a_picture_that_is_too_large(self):
        self.assertIn("100000", self.refused("--technique", "pcss", "--size", "100000x10"))

    def test_more_references_than_memory_should_hold(self):
        self.assertIn("2 GiB", self.refused("--technique", "pcss", "--size", "4096x4096", "--frames", "0:99"))

    def test_techniques(self):
        self.assertIn("--technique is required", self.refused())
        self.assertIn("'pcss' twice", self.refused("--technique", "pcss,hard,pcss"))
        self.assertIn("follows no technique", self.refused("--technique", "pcss,pcss.filter_taps=4"))
        self.assertIn("a name is missing", self.refused("--technique", "hard,,pcss"))
        self.assertIn("see --technique", self.refused("--technique", "pcss", "--set", "technique=hard"))

    def test_lights_and_casters_are_the_references(self):
        for value, what in (("sun.angle=2", "another sun"), ("casters.skies=on", "other casters"),
                            ("lamps.near=0.5", "other casters")):
            error = self.refused("--technique", f"hard,pcss:{value}")
            self.assertIn(f"'{value}' would give a technique {what} than the reference's", error)

    def test_options_that_do_not_go_together(self):
        self.assertIn("--frames", self.refused("--technique", "pcss", "--orbit", "2"))
        self.assertIn("--orbit", self.refused("--technique", "pcss", "--cut-at", "2"))
        self.assertIn("0:9", self.refused("--technique", "pcss", "--frames", "0:9", "--orbit", "2", "--cut-at", "10"))
        self.assertIn("every frame but the first is timed",
                      self.refused("--technique", "pcss", "--frames", "0:3", "--cost-frames", "50"))
        self.assertIn("--spp", self.refused("--technique", "pcss", "--reference", "brute_force", "--spp", "64"))

    def test_scenes_that_are_not_there(self):
        self.assertIn("nothing.glb", self.refused("--technique", "pcss", code=1, of=self.folder / "nothing.glb"))
        # A fault of the second scene is also reported before the first is drawn.
        scenes = (POSTS, self.folder / "none.glb")
        line = self.refuse("compare", *scenes, "-o", self.folder / "report", "--technique", "pcss")
        self.assertIn("none.glb", line)

    def test_a_camera_that_is_in_one_scene_alone(self):
        scenes = (scene("fence"), POSTS)
        line = self.refuse("compare", *scenes, "-o", self.folder / "report", *SMALL, "--technique", "pcss", "--camera",
                           "close", timeout=60)
        self.assertIn(f"'{POSTS}'", line)
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_folders_that_cannot_be_written(self):
        (self.folder / "file").write_text("mine")
        line = self.refuse("compare", POSTS, "-o", self.folder / "file", "--technique", "pcss")
        self.assertIn("is not a folder", line)
        self.assertEqual((self.folder / "file").read_text(), "mine")
        line = self.refuse("compare", POSTS, "-o", "/proc/report", "--technique", "pcss")
        self.assertIn("/proc/report/index.html", line)

    def test_a_full_disk_is_an_error_and_leaves_no_file(self):
        def few_bytes():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))

        folder = self.folder / "report"
        self.assertIn("index.html", self.refuse("compare", POSTS, "-o", folder, *SMALL, *SMALL_MAPS, *BRUTE,
                                                preexec_fn=few_bytes))
        self.assertEqual([path for path in self.folder.rglob("*") if path.is_file()], [])

    def test_signals_leave_no_file(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(number):
                process = subprocess.Popen([PROGRAM, "compare", POSTS, "-o", self.folder / "report", "--size", "64x36",
                                            "--technique", "pcss", "--reference", "brute_force", "--frames", "0:99999"])
                wait_until_it_catches(number, process)
                time.sleep(1)  # it most often draws by then; nothing must be left in any case
                process.send_signal(number)
                self.assertEqual(process.wait(timeout=60), 128 + number)
                self.assertEqual(list(self.folder.iterdir()), [])

    def test_a_report_keeps_its_files_when_the_next_one_fails(self):
        folder = self.folder / "report"
        self.succeed("compare", POSTS, "-o", folder, *SMALL, *SMALL_MAPS, *BRUTE)
        before = {path.name: path.read_bytes() for path in folder.iterdir()}
        bad = self.folder / "bad.glb"
        bad.write_bytes(POSTS.read_bytes()[:200])
        self.refuse("compare", POSTS, bad, "-o", folder, *SMALL, *SMALL_MAPS, *BRUTE)
        self.assertEqual({path.name: path.read_bytes() for path in folder.iterdir()}, before)


if __name__ == "__main__":
    main()
