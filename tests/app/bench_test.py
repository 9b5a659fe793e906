"""penumbra bench: what it writes agrees with itself. How long anything takes is no matter of a test."""

import csv
import json
import math
import re
import shlex
import shutil
import signal
import statistics
import subprocess
import time

from support import PROGRAM, ROOT, TestCase, main, wait_until_it_catches

SCENE = ROOT / "scenes" / "steps.glb"
SMALL = ("--size", "64x36", "--set", "cascades.size=64", "--frames", "2", "--warmup", "1")


class Bench(TestCase):
    def bench(self, *arguments):
        """Runs it with a JSON file, which it returns read."""
        self.succeed("bench", *arguments, *SMALL, "-o", "bench.json", cwd=self.folder)
        return json.loads((self.folder / "bench.json").read_text())

    def read_csv(self):
        with open(self.folder / "bench.csv", newline="") as file:
            return list(csv.DictReader(file))

    def test_passes_make_up_what_is_told_of_them(self):
        data = self.bench(SCENE, "--technique", "pcss,thesis_8x8,none")
        costs = data["points"][0]["costs"]
        self.assertEqual([cost["label"] for cost in costs], ["pcss", "thesis_8x8", "none"])
        for cost in costs:
            frame = cost["frame"]
            # Medians of sums are no sums of medians; of two frames they are.
            for name, passes in {"passes_sum": cost["passes"],
                                 "shadow_passes": [each for each in cost["passes"] if each["shadow"]]}.items():
                self.assertAlmostEqual(sum(each["median_ms"] for each in passes), cost[name]["median_ms"], delta=0.01)
            self.assertLessEqual(frame["min_ms"], frame["median_ms"])
            self.assertLessEqual(frame["median_ms"], frame["max_ms"])
            self.assertEqual(frame["frames"], 2)
            self.assertEqual(cost["cpu"]["frames"], 2)
            self.assertGreater(cost["cpu"]["min_ms"], 0)
            self.assertLessEqual(cost["cpu"]["min_ms"], cost["cpu"]["median_ms"])
            # Only checks that the field is consistent: on a busy machine the passes may not add up to the frame.
            self.assertEqual(cost["adds_up"], 0.9 < cost["passes_sum_over_frame"] < 1.1)
            for each in cost["passes"]:
                self.assertAlmostEqual(each["share"], each["median_ms"] / frame["median_ms"], delta=0.001)
        self.assertEqual(costs[0]["shadow_over_first"], 1)
        self.assertIn("filter", {each["name"] for each in costs[1]["passes"]})
        self.assertNotIn("shadow map", {each["name"] for each in costs[2]["passes"]})

    def test_measures_rays_that_techniques_trace_as_shadow_passes(self):
        data = self.bench(SCENE, "--technique", "pcss,hybrid", "--floor")
        passes = {each["name"]: each for each in data["points"][0]["costs"][1]["passes"]}
        for name in ("shadow map", "surface ids", "tile decisions", "pixels for rays", "rays"):
            self.assertTrue(passes[name]["shadow"], name)

    def test_whole_frames_have_no_passes_on_a_software_rasteriser(self):
        text = self.succeed("bench", SCENE, "--technique", "none,pcss", "--whole-frames", *SMALL, "-o",
                            self.folder / "bench.json", "-o", self.folder / "bench.csv", "-o",
                            self.folder / "bench.html").stdout
        data = json.loads((self.folder / "bench.json").read_text())
        if not data["device"]["software"]:
            self.skipTest("a GPU's timers wait for nothing, so passes are timed with frames")
        self.assertIn("each frame", data["timing"])
        self.assertIn("whole frames", text)
        self.assertNotIn("warning", text)
        for cost in data["points"][0]["costs"]:
            self.assertNotIn("passes", cost)
            self.assertEqual(cost["frame"]["frames"], 2)
            self.assertGreater(cost["frame"]["min_ms"], 0)
        self.assertEqual([cost["label"] for cost in data["points"][0]["costs"]], ["none", "pcss"])
        self.assertEqual(data["points"][0]["costs"][0]["frame_over_first"], 1)
        self.assertEqual({row["pass"] for row in self.read_csv()}, {"frame", "CPU"})
        self.assertIn("whole frames", (self.folder / "bench.html").read_text())

    def test_says_whether_maps_were_drawn_anew_or_kept(self):
        for setting, said in ((None, "drawn anew in every frame"), ("on", "kept where nothing moved"),
                              ("off", "drawn anew in every frame")):
            arguments = ("--set", f"maps.keep={setting}") if setting else ()
            text = self.succeed("bench", SCENE, *SMALL, *arguments, "-o", self.folder / "bench.json", "-o",
                                self.folder / "bench.csv").stdout
            data = json.loads((self.folder / "bench.json").read_text())
            self.assertEqual(data["maps"], said)
            self.assertIn(f"maps {said}", text)
            self.assertEqual({row["maps"] for row in self.read_csv()}, {said})
            drawn = sum(each["max_ms"] for each in data["points"][0]["costs"][0]["passes"]
                        if each["name"] in ("shadow map", "depth pyramid"))
            self.assertEqual(drawn > 0, setting != "on")

    def test_an_animation_that_plays_moves_its_casters(self):
        for arguments, moves in ((("--play",), True), ((), False)):
            data = self.bench(ROOT / "scenes" / "moving.glb", "--technique", "hard", "--set", "maps.keep=on", *arguments)
            drawn = [each["max_ms"] for each in data["points"][0]["costs"][0]["passes"] if each["name"] == "shadow map"]
            self.assertEqual(max(drawn, default=0) > 0, moves)

    def test_says_with_what_it_was_measured_and_not_where(self):
        shutil.copy(SCENE, self.folder)
        data = self.bench("steps.glb", "--technique", "pcss", "--set", "pcss.filter_taps=5")
        for field in ("version", "commit", "timing", "backend"):
            self.assertTrue(data[field], field)
        self.assertRegex(data["commit"], r"^([0-9a-f]{12}(-changed)?|unknown)$")
        self.assertGreater(data["machine"]["cores"], 0)
        self.assertTrue(data["device"]["renderer"])
        self.assertEqual((data["points"][0]["width"], data["points"][0]["height"]), (64, 36))
        self.assertEqual(data["techniques"][0]["params"]["pcss.filter_taps"], 5)
        self.assertEqual(data["scene"], "steps.glb")
        text = (self.folder / "bench.json").read_text()
        self.assertNotIn(str(ROOT), text)
        self.assertNotIn(str(self.folder), text)

    def test_csv_has_the_figures_of_the_json(self):
        data = self.bench(SCENE, "--technique", "pcss,pcf", "--floor", "-o", self.folder / "bench.csv")
        rows = {(row["label"], row["pass"]): row for row in self.read_csv()}
        for cost in data["points"][0]["costs"]:
            figures = {each["name"]: each for each in cost["passes"]}
            figures |= {"frame": cost["frame"], "CPU": cost["cpu"], "shadow passes": cost["shadow_passes"],
                        "sum of passes": cost["passes_sum"], "floor: fetches": cost["floor"]["fetches"],
                        "floor: mask copy": cost["floor"]["mask_copy"]}
            self.assertEqual({name for label, name in rows if label == cost["label"]}, set(figures))
            for name, figure in figures.items():
                row = rows[cost["label"], name]
                for field in ("median_ms", "min_ms", "max_ms"):
                    self.assertEqual(float(row[field]), figure[field])
                self.assertEqual(row["commit"], data["commit"])
                self.assertEqual(row["renderer"], data["device"]["renderer"])

    def test_floor_stands_beside_techniques_with_taps(self):
        costs = self.bench(SCENE, "--technique", "pcss,pcf,hard", "--floor")["points"][0]["costs"]
        for cost in costs[:2]:
            self.assertGreater(cost["floor"]["fetches"]["median_ms"], 0)
            self.assertGreater(cost["floor"]["mask_over_fetches"], 0)
        self.assertIsNone(costs[2]["floor"]["fetches"])
        for cost in costs:
            self.assertGreater(cost["floor"]["mask_copy"]["median_ms"], 0)

    def test_floor_measures_masks_of_which_every_pixel_is_computed(self):
        for arguments, has_floor in ((("--floor",), True), ((), False)):
            text = self.succeed("bench", SCENE, "--technique", "pcss", *arguments, *SMALL, "-o",
                                self.folder / "bench.json", "-o", self.folder / "bench.csv").stdout
            data = json.loads((self.folder / "bench.json").read_text())
            params = data["techniques"][0]["params"]
            self.assertEqual((params["mask.tiles"], params["pcss.early_exit"]), (not has_floor, not has_floor))
            passes = {each["name"] for each in data["points"][0]["costs"][0]["passes"]}
            self.assertEqual("tile decisions" in passes, not has_floor)
            self.assertEqual(data["mask_details"], has_floor)
            self.assertEqual({row["mask_details"] for row in self.read_csv()}, {str(has_floor).lower()})
            self.assertEqual("masks with details, of which every pixel is computed" in text, has_floor)

    def test_sweep_of_taps_fits_a_cost_model(self):
        page = self.folder / "bench.html"
        data = self.bench(SCENE, "--sweep", "taps", "-o", self.folder / "bench.csv", "-o", page)
        places = [(point["blocker_taps"], point["filter_taps"]) for point in data["points"]]
        self.assertEqual(places, [(a, b) for a in (8, 32, 64, 128) for b in (8, 32, 64, 128)])
        times = [point["costs"][0]["swept"]["median_ms"] for point in data["points"]]
        model = data["models"][0]
        slopes = model["ms_per"]
        errors = [ms - model["constant_ms"] - a * slopes["blocker_taps"] - b * slopes["filter_taps"]
                  for (a, b), ms in zip(places, times)]
        # Least squares: nothing is left along any of the model's directions.
        self.assertAlmostEqual(math.fsum(errors), 0, delta=0.01)
        self.assertAlmostEqual(math.fsum(e * a for e, (a, _) in zip(errors, places)), 0, delta=1)
        mean = statistics.fmean(times)
        explained = 1 - sum(e * e for e in errors) / sum((ms - mean) ** 2 for ms in times)
        self.assertAlmostEqual(model["r_squared"], explained, delta=0.01)
        masks = [row for row in self.read_csv() if row["pass"] == "shadow mask"]
        self.assertEqual([(float(row["blocker_taps"]), float(row["filter_taps"])) for row in masks], places)
        for row, ms in zip(masks, times):
            self.assertAlmostEqual(float(row["median_ms"]), ms, delta=1e-4)
        text = page.read_text()
        self.assertIn("ms = ", text)
        self.assertIsNone(re.search(r"(src|href)\s*=\s*.?https?:", text), "the page asks the network")

    def test_sweeps_change_what_they_say(self):
        for name, field in {"resolution": "width", "sun_angle": "sun_angle", "cascades": "cascades"}.items():
            data = self.bench(SCENE, "--sweep", name)
            values = [point[field] for point in data["points"]]
            self.assertEqual(values, sorted(set(values)), name)
            self.assertEqual(data["sweep"], name)
        lamps = ("--lamp", "1,3,0", "--lamp", "0,3,1", "--lights", "none")
        data = self.bench(SCENE, "--sweep", "lights", "--sun", "20,50", "--set", "lamps.size=64", *lamps)
        self.assertEqual([point["lights"] for point in data["points"]], [1, 2, 3])
        memory = [point["costs"][0]["shadow_bytes"] for point in data["points"]]
        self.assertEqual(memory, sorted(set(memory)))
        memory = [point["costs"][0]["shadow_bytes"] for point in self.bench(SCENE, "--sweep", "cascades")["points"]]
        self.assertEqual(memory, sorted(set(memory)))

    def test_casters_are_instanced(self):
        data = self.bench("--sweep", "casters", "--technique", "hard", "--set", "cascades.count=1")
        self.assertEqual([point["triangles"] - 2 for point in data["points"]], [1000, 10000, 100000, 1000000])

    def test_presets_are_techniques_too(self):
        preset = self.folder / "mine.toml"
        preset.write_text('technique = "pcss"\npcss.filter_taps = 3\n')
        data = self.bench(SCENE, "--technique", f"pcss,{preset}")
        self.assertEqual([each["label"] for each in data["techniques"]], ["pcss", "mine"])
        self.assertEqual([each["params"]["pcss.filter_taps"] for each in data["techniques"]], [16, 3])
        # As it can be typed again.
        command = shlex.split(data["command"])
        self.assertEqual(command[:4], ["penumbra", "bench", str(SCENE), "--technique"])
        (self.folder / "bench.json").unlink()
        self.succeed(*command[1:], cwd=self.folder)
        again = json.loads((self.folder / "bench.json").read_text())
        self.assertEqual((again["command"], again["techniques"]), (data["command"], data["techniques"]))

    def test_refuses_what_it_cannot_do(self):
        for arguments, said in {
            ("--technique", "pcs"): "did you mean 'pcf'",
            ("--technique", "pcss,pcss"): "twice",
            ("--technique", "pcss,truth"): "see penumbra truth",
            ("--set", "technique=truth"): "see penumbra truth",
            ("--technique", "pcss,hard", "--set", "technique=esm"): "see --technique",
            ("--technique", "pcss,,hard"): "empty",
            ("--technique", "hard", "--sweep", "taps"): "hard.blocker_taps",
            ("--sweep", "taps", "--set", "pcss.filter_taps=4"): "--sweep taps sets pcss.filter_taps",
            ("--sweep", "map_size", "--set", "cascades.size=64"): "--sweep map_size sets cascades.size",
            ("--sweep", "sun_angle", "--sun-angle", "2"): "--sweep sun_angle sets sun.angle",
            ("--sweep", "tap"): "did you mean 'taps'",
            ("--frames", "0"): "--frames",
            ("-o", "bench.xml"): ".json, .csv, .html",
            ("--quiet",): "-o",
            ("--floor", "--set", "mask.tiles=on"): "--floor measures with mask.tiles=false",
            ("--floor", "--set", "mask.scale=2"): "--floor measures with mask.scale=1",
        }.items():
            self.assertIn(said, self.refuse("bench", SCENE, *arguments, code=2), arguments)
        self.assertIn("SCENE", self.refuse("bench", code=2))
        for name in ("sun_angle", "cascades", "map_size"):
            arguments = ("--sweep", name, "--no-sun", "--lamp", "1,2,3", "--technique", "hard")
            self.assertIn("no sun shines", self.refuse("bench", SCENE, *arguments))

    def test_no_output_overwrites_a_file_of_the_scene(self):
        names = ("s.json", "data.csv")
        for name in names:
            (self.folder / name).write_text(json.dumps({"asset": {"version": "2.0"}, "images": [{"uri": "data.csv"}]}))
        before = (self.folder / "s.json").read_text()
        for name in names:
            said = self.refuse("bench", self.folder / "s.json", "-o", self.folder / name, *SMALL, code=2)
            self.assertIn("overwrite the scene's file", said)
            self.assertEqual((self.folder / name).read_text(), before)

    def test_no_output_takes_the_place_of_another(self):
        (self.folder / "b.csv").symlink_to(self.folder / "b.json")
        for first, second in (("b.json", "./b.json"), ("b.json", "b.csv")):
            said = self.refuse("bench", SCENE, "-o", first, "-o", second, cwd=self.folder, code=2)
            self.assertIn(f"'{second}' would replace the output '{first}'", said)

    def test_unwritable_output_is_told_before_anything_is_measured(self):
        blocker = self.folder / "file"
        blocker.write_text("")
        said = self.refuse("bench", SCENE, "--frames", "100000", "-o", blocker / "bench.json", timeout=60)
        self.assertIn("cannot write", said)

    def test_ctrl_c_leaves_nothing(self):
        run = subprocess.Popen([PROGRAM, "bench", SCENE, "--size", "64x36", "--frames", "100000", "-o",
                                self.folder / "bench.json"], stderr=subprocess.PIPE, stdout=subprocess.PIPE)
        wait_until_it_catches(signal.SIGINT, run)
        time.sleep(1)  # it most often measures by then; nothing must be left in any case
        run.send_signal(signal.SIGINT)
        out, _ = run.communicate(timeout=60)
        self.assertEqual(run.returncode, 130)
        self.assertEqual(out, b"")
        self.assertEqual(list(self.folder.iterdir()), [])


if __name__ == "__main__":
    main()
