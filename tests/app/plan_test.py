"""penumbra plan, work and merge: the report of items that were drawn one by one is that of the whole command."""

import json
import os
import pathlib
import signal
import struct
import subprocess

from pictures import SMALL_MAPS, scene
from plans import COMPARED, TINY, Plans
from schemas import validator
from support import PROGRAM, ROOT, main, run, wait_until_it_catches

SEQUENCE = (scene("moving"), "--technique", "pcss", "--set", "cascades.size=256", *TINY)


class Compared(Plans):
    def test_the_same_report_as_one_process(self):
        # The report names its folder, so both are written to the same one.
        self.succeed("compare", *COMPARED, "--no-cost", "-o", self.folder / "report")
        whole = self.contents("report")
        self.assertEqual(sorted(whole), ["index.html", "results.csv", "results.json"])
        counts = self.make("compare", *COMPARED, "--no-cost")
        self.assertEqual(counts["items"], "6")
        for item in (5, 0, 3, 1, 4, 2):
            self.work("--item", item)
        self.assertEqual(self.merge("report"), whole)

    def test_a_sequence_with_an_orbit_and_a_history(self):
        arguments = (scene("moving"), "--technique", "thesis,hard", "--frames", "0:17", "--orbit", "1", "--spp", "8",
                     "--size", "48x27", "--set", "cascades.size=256", "--no-cache", "--no-cost")
        self.succeed("compare", *arguments, "-o", self.folder / "report")
        whole = self.contents("report")
        self.make("compare", *arguments)
        self.work()
        self.assertEqual(self.merge("report"), whole)

    def test_several_lights(self):
        arguments = (scene("gallery"), "--technique", "hard,pcf", "--spp", "8", *TINY, *SMALL_MAPS,
                     "--no-cache", "--no-cost")
        self.succeed("compare", *arguments, "-o", self.folder / "report")
        whole = self.contents("report")
        self.make("compare", *arguments)
        self.work()
        self.assertEqual(self.merge("report"), whole)

    def test_techniques_that_are_timed_stay_together(self):
        arguments = (*COMPARED, "--cost-frames", "1")
        self.assertEqual(self.make("compare", *arguments)["items"], "2")
        self.work()
        first, again = self.merge("report"), self.merge("report")
        self.assertEqual(first, again, "a merge of the same results")
        merged = json.loads(first["results.json"])
        self.succeed("compare", *arguments, "-o", self.folder / "report")
        whole = json.loads(self.contents("report")["results.json"])
        for document in (merged, whole):
            for one in document["scenes"]:
                for technique in one["techniques"]:
                    self.assertGreater(technique.pop("cost")["median_ms"], 0)
        self.assertEqual(merged, whole)

    def test_times_of_different_machines_are_not_merged(self):
        """Mesa's vectors of 128 bits stand for another processor: the renderer's name has their width."""
        other = {**os.environ, "GALLIUM_OVERRIDE_CPU_CAPS": "sse4.1"}
        for costs in ((), ("--no-cost",)):
            self.make("compare", *COMPARED, *costs)
            self.work("--item", 0)
            self.work("--item", 1, env=other)
            self.work()
        renderers = {json.loads(data.split(b"\n", 1)[0])["data"]["device"]["renderer"] for data in self.results().values()}
        if len(renderers) == 1:
            self.skipTest("this renderer's name is the same with other vectors")
        told = self.succeed("merge", self.plan, "-o", self.folder / "report").stderr
        self.assertIn("warning: 1 of 6 results were drawn by other devices", told)
        self.make("compare", *COMPARED)
        self.assertIn("item 1 was measured on another machine", self.refuse("merge", self.plan, "-o", self.folder / "timed"))
        self.assertFalse((self.folder / "timed").exists())

    def test_a_report_without_costs_has_none(self):
        self.succeed("compare", *COMPARED, "--no-cost", "-o", self.folder / "report")
        report = self.contents("report")
        document = json.loads(report["results.json"])
        self.assertTrue(validator("compare").is_valid(document))
        self.assertEqual({technique["cost"] for one in document["scenes"] for technique in one["techniques"]}, {None})
        self.assertNotIn(b"Cost against error", report["index.html"])
        self.assertIn("--cost-frames", self.refuse("compare", *COMPARED, "--no-cost", "--cost-frames", "2", "-o",
                                                   self.folder / "x", code=2))


class Drawn(Plans):
    def test_frames_of_a_sequence(self):
        arguments = (*SEQUENCE, "--aov", "shadow,motion", "--frames", "0:6", "--fps", "12")
        self.succeed("render", *arguments, "-o", self.folder / "whole" / "frame.png")
        self.assertEqual(self.make("render", *arguments, "--frames-per-item", 2)["items"], "4")
        self.assertEqual([item["frames"] for item in self.document()["items"]], [[0, 1], [2, 3], [4, 5], [6, 6]])
        self.work("--items", "1:9")
        self.work("--item", "0")
        merged = self.merge()
        self.assertEqual(len(merged), 21)
        self.assertEqual(merged, self.contents("whole"))

    def test_layers(self):
        arguments = (*SEQUENCE, "--aov", "shadow", "--frames", "2:3", "--supersample", "2")
        self.succeed("render", *arguments, "-o", self.folder / "whole" / "a_##.exr")
        self.make("render", *arguments, "--frames-per-item", 1, "--file", "a_##.exr")
        self.work()
        self.assertEqual(self.merge(), self.contents("whole"))

    def test_a_single_picture(self):
        arguments = (scene("steps"), *TINY, "--set", "cascades.size=256")
        self.succeed("render", *arguments, "-o", self.folder / "whole" / "frame.png")
        self.assertEqual(self.make("render", *arguments)["items"], "1")
        self.work()
        self.assertEqual(self.merge(), self.contents("whole"))

    def test_where_frames_depend_on_each_other(self):
        arguments = (scene("moving"), "--technique", "thesis", *TINY, "--set", "cascades.size=256", "--frames", "0:8")
        result = self.succeed("plan", "render", *arguments, "-o", self.plan)
        self.assertIn("items 1\n", result.stdout)
        self.assertIn("warning: each frame depends on those before it (history.reuse), so", result.stderr)
        self.succeed("render", *arguments, "-o", self.folder / "whole" / "frame.png")
        self.work()
        whole = self.contents("whole")
        self.assertEqual(self.merge("one"), whole)
        error = self.refuse("plan", "render", *arguments, "-o", self.plan, "--frames-per-item", "3", code=2)
        self.assertIn("--lead-in", error)
        # Divided: the first item is exact, and so is one whose lead-in begins where the sequence does.
        result = self.succeed("plan", "render", *arguments, "-o", self.plan, "--frames-per-item", 3, "--lead-in", 3)
        self.assertIn("from frame 6 on", result.stderr)
        self.assertEqual(self.succeed("work", self.plan).stderr, "", "told when the plan was made")
        divided = self.merge("divided")
        same = sorted(name for name in whole if divided[name] == whole[name])
        self.assertEqual(same, [f"frame_{i:04}.png" for i in range(6)])
        result = self.succeed("plan", "render", *arguments, "-o", self.plan, "--frames-per-item", 5, "--lead-in", 5)
        self.assertEqual(result.stderr, "", "all items are exact")

    def test_the_estimate_counts_the_shadows_of_all_samples(self):
        view = (scene("steps"), "--size", "640x360", "--technique", "pcss", "--samples", "8")
        first, own = (self.make("render", *view, *more) for more in ((), ("--sample-shadows",)))
        for name in ("seconds", "memory_mib"):
            self.assertGreater(float(own[name]), float(first[name]), name)

    def test_a_warm_up_before_a_lead_in_that_begins_at_the_first_frame(self):
        for still in ((), ("--warmup-still",)):
            arguments = (scene("moving"), "--technique", "thesis", *TINY, "--set", "cascades.size=256", "--frames",
                         "0:3", "--warmup", "8", *still)
            whole = f"whole{len(still)}"
            self.succeed("render", *arguments, "-o", self.folder / whole / "frame.png")
            self.make("render", *arguments, "--frames-per-item", 2, "--lead-in", 2)
            self.assertEqual(self.work(), "2 done, 0 there already, 0 failed\n")
            self.assertEqual(self.merge(f"merged{len(still)}"), self.contents(whole))

    def test_traced_frames(self):
        arguments = (scene("moving"), "--spp", "8", *TINY, *SMALL_MAPS, "--frames", "0:2", "--no-cache")
        self.succeed("truth", *arguments, "-o", self.folder / "whole" / "truth.exr")
        self.make("truth", *arguments, "--frames-per-item", 2)
        self.work()
        self.assertEqual(self.merge(), self.contents("whole"))

    def test_pictures_of_every_light(self):
        for command, more in (("truth", ("--spp", "8")), ("render", ("--technique", "hard", "--aov", "shadow,depth"))):
            with self.subTest(command):
                arguments = (scene("gallery"), *more, *TINY, *SMALL_MAPS, "--frames", "0:2", "--no-cache")
                self.succeed(command, *arguments, "-o", self.folder / command / "x.png")
                whole = self.contents(command)
                self.assertIn("x_0002.shadow_4.png", whole)
                self.make(command, *arguments, "--file", "x.png", "--frames-per-item", 2)
                self.work()
                self.assertEqual(self.merge(f"merged-{command}"), whole)

    def test_options_that_a_plan_does_not_take(self):
        for arguments, word in ((["--stats", "x.json"], "--stats"), (["--save-preset", "x.toml"], "--save-preset"),
                                (["--file", "a/b.png"], "folder"), (["--file", "b.gif"], ".png"),
                                (["--lead-in", "3"], "--frames"), (["-o", "b.json"], "twice")):
            error = self.refuse("plan", "render", scene("steps"), "-o", self.plan, *arguments, code=2)
            self.assertIn(word, error)
        self.assertIn("--lead-in is of no use",
                      self.refuse("plan", "render", *SEQUENCE, "--frames", "0:3", "--lead-in", 2, "-o", self.plan, code=2))
        self.assertIn(".json", self.refuse("plan", "render", scene("steps"), "-o", self.folder / "x.png", code=2))
        self.assertIn("--output is required", self.refuse("plan", "compare", scene("steps"), "--technique", "hard", code=2))
        self.assertIn("'compare'", self.refuse("plan", "compar", code=2))
        self.assertEqual(list(self.folder.iterdir()), [])


class Timed(Plans):
    def test_a_merge_of_the_same_results_is_the_same(self):
        arguments = (scene("steps"), "--technique", "hard,pcss", "--sweep", "sun_angle", *TINY, "--frames", "1",
                     "--set", "cascades.size=256")
        self.assertEqual(self.make("bench", *arguments)["items"], "7")
        self.work("--items", "3:6")
        self.work()
        first = self.merge()
        self.assertEqual(sorted(first), ["index.html", "results.csv", "results.json"])
        self.assertEqual(first, self.merge())
        merged = json.loads(first["results.json"])
        self.assertTrue(validator("bench").is_valid(merged))
        for name in first:
            self.assertIn(f"-o {self.folder / 'merged' / name}", merged["command"])
        # But for times, which are of other frames, it is what one process writes.
        self.succeed("bench", *arguments, "-o", self.folder / "whole.json")
        whole = json.loads((self.folder / "whole.json").read_text())
        for key in ("techniques", "sweep", "sweep_measures", "device", "backend", "timing", "maps", "mask_details",
                    "scene", "measured_frames", "warmup_frames"):
            self.assertEqual(merged[key], whole[key], key)
        for one, other in zip(merged["points"], whole["points"], strict=True):
            costs = [one.pop("costs"), other.pop("costs")]
            self.assertEqual(one, other)
            self.assertEqual(*[[[cost["label"], cost["shadow_bytes"]] for cost in list_] for list_ in costs])
        self.assertEqual([model["label"] for model in merged["models"]], ["hard", "pcss"])

    def test_keys_of_generated_casters_depend_on_shaders(self):
        glsl = self.folder / "glsl"
        glsl.mkdir()

        def keys(*more):
            self.make("bench", "--sweep", "casters", "--technique", "hard", *TINY, "--set", "cascades.size=256", *more)
            return {item["key"] for item in self.document()["items"]}

        seen = keys()
        for text in ("// one\n", "// two\n"):
            (glsl / "a.glsl").write_text(text)
            new = keys("--glsl", glsl)
            self.assertFalse(seen & new, text)
            seen |= new

    def test_floors_and_whole_frames(self):
        for more in (["--floor", "--technique", "pcss,hard"], ["--whole-frames"]):
            self.make("bench", scene("steps"), *more, *TINY, "--frames", "2", "--set", "cascades.size=256")
            self.work()
            first = self.merge()
            self.assertTrue(validator("bench").is_valid(json.loads(first["results.json"])))
            page = first["index.html"].decode()
            self.assertIn("4 cascades of 256×256", page)
            self.assertEqual("masks with details" in page, "--floor" in more)
            self.assertEqual(first, self.merge())


class Folder(Plans):
    """What is in the shared folder, and what is done again."""

    def setUp(self):
        super().setUp()
        self.make("compare", *COMPARED, "--no-cost")
        self.keys = [item["key"] for item in self.document()["items"]]

    def file(self, item, ending="result"):
        return self.folder / "sweep.results" / self.keys[item][:2] / f"{self.keys[item]}.{ending}"

    def test_what_is_there_is_skipped_and_what_is_damaged_is_done_again(self):
        self.assertEqual(self.work("--items", "0:1"), "2 done, 0 there already, 0 failed\n")
        before = self.results()
        self.assertEqual(len(before), 2)
        self.assertEqual(self.work("--items", "0:1"), "0 done, 2 there already, 0 failed\n")
        good = self.file(1).read_bytes()
        for bad in (good[:-1], good[: len(good) // 2], b"", good.replace(b"receivers", b"receivees", 1), good + b"x"):
            self.file(1).write_bytes(bad)
            self.assertEqual(self.work("--items", "0:1"), "1 done, 1 there already, 0 failed\n")
            self.assertEqual(self.results(), before, "a result depends on its item alone")

    def test_missing_items_are_listed(self):
        self.work("--items", "2:5")
        result = run("merge", self.plan, "-o", self.folder / "report")
        self.assertEqual(result.returncode, 1)
        self.assertEqual(result.stdout, "item 0 (steps.glb, hard): not drawn\nitem 1 (posts.glb, hard): not drawn\n")
        self.assertIn("2 of 6 items", result.stderr)
        self.assertFalse((self.folder / "report").exists())

    def test_scenes_of_one_name_are_told_apart(self):
        scenes = [self.folder / name / "same.glb" for name in ("one", "two")]
        for path, name in zip(scenes, ("steps", "posts")):
            path.parent.mkdir()
            path.write_bytes(scene(name).read_bytes())
        self.make("compare", *scenes, *COMPARED[2:], "--no-cost")
        listed = run("merge", self.plan, "-o", self.folder / "report").stdout.splitlines()
        self.assertEqual(listed[:2], ["item 0 (one/same.glb, hard): not drawn", "item 1 (two/same.glb, hard): not drawn"])
        self.work()
        page = self.merge("report")["index.html"].decode()
        self.assertIn("<title>Shadow techniques on one/same, two/same</title>", page)
        for name in ("one/same", "two/same"):
            self.assertIn(f">{name}</h2>", page)
            self.assertIn(f"View and lights of {name}<", page)

    def test_a_damaged_result_stops_a_merge(self):
        self.work()
        data = bytearray(self.file(3).read_bytes())
        data[len(data) // 2] ^= 1
        self.file(3).write_bytes(data)
        error = self.refuse("merge", self.plan, "-o", self.folder / "report")
        self.assertIn("item 3 (posts.glb, pcss:pcss.filter_taps=4): its result", error)
        self.assertFalse((self.folder / "report").exists())

    def test_failures_leave_their_message_and_are_done_again(self):
        # There is no device of this number, which is known only when an item opens it.
        self.make("compare", scene("steps"), "--technique", "hard,pcf", "--spp", "8", *TINY, "--no-cache", "--no-cost",
                  "--egl-device", "200")
        self.keys = [item["key"] for item in self.document()["items"]]
        error = self.refuse("work", self.plan)
        self.assertIn("2 of 2 items failed, item 0 first: ", error)
        message = self.file(0, "failed").read_text()
        self.assertIn("200", message)
        listed = run("merge", self.plan, "-o", self.folder / "report")
        self.assertEqual(listed.stdout.splitlines()[0], f"item 0 (steps.glb, hard): failed: {message.strip()}")
        self.make("compare", *COMPARED, "--no-cost")
        self.keys = [item["key"] for item in self.document()["items"]]
        self.file(4, "failed").parent.mkdir(parents=True, exist_ok=True)
        self.file(4, "failed").write_text("the driver fell over\n")
        listed = run("merge", self.plan, "-o", self.folder / "report")
        self.assertIn("item 4 (steps.glb, slices_denoised): failed: the driver fell over", listed.stdout)
        self.work("--item", "4")
        self.assertFalse(self.file(4, "failed").exists())

    def test_an_added_technique_leaves_the_other_results(self):
        self.work()
        longer = list(COMPARED)
        longer[3] += ",pcf"
        self.make("compare", *longer, "--no-cost")
        self.assertEqual(self.work(), "2 done, 6 there already, 0 failed\n")
        self.assertEqual(len(json.loads(self.merge()["results.json"])["scenes"][1]["techniques"]), 4)

    def test_keys_depend_on_what_is_drawn(self):
        def keys(*more, of=COMPARED):
            self.make("compare", *of, "--no-cost", *more)
            return {item["key"] for item in self.document()["items"]}

        self.assertEqual(keys("--quiet", "--threads", "1"), set(self.keys))
        seen = set(self.keys)
        for more in (["--sun-angle", "2"], ["--set", "maps.layers=2"], ["--eye", "1,2,3", "--target", "0,0,0"],
                     ["--warmup", "3"], ["--ground", "on"], ["--backend", "osmesa"],
                     ["--set", "truth.seed=3"]):
            new = keys(*more)
            self.assertFalse(seen & new, more)
            seen |= new
        # The content of the scene, of files that it refers to, and of shaders.
        path = self.folder / "scene.glb"
        path.write_bytes(scene("steps").read_bytes())
        copied = (path, *COMPARED[2:])
        first = keys(of=copied)
        self.assertTrue(first < set(self.keys), "the same content under another name")
        glsl = self.folder / "glsl"
        glsl.mkdir()
        (glsl / "a.glsl").write_text("// one\n")
        with_shaders = keys("--glsl", glsl, of=copied)
        (glsl / "a.glsl").rename(glsl / "b.glsl")
        renamed = keys("--glsl", glsl, of=copied)
        self.assertFalse(with_shaders & renamed, "the same content in place of another shader")
        self.assertEqual([file.get("shader") for file in self.document()["scenes"][0]["files"]], [None, "b.glsl"])
        self.assertEqual([error.message for error in validator("plan").iter_errors(self.document())], [])
        (glsl / "b.glsl").write_text("// two\n")
        self.assertFalse((with_shaders | renamed) & keys("--glsl", glsl, of=copied))

    def test_keys_of_times_depend_on_the_number_of_threads(self):
        def keys(*more):
            self.make("compare", *COMPARED, *more)
            return {item["key"] for item in self.document()["items"]}

        usual, one = keys(), keys("--threads", "1")
        self.assertFalse(usual & one)
        self.assertEqual(one, keys("--threads=1"))

    def test_a_scene_that_changed_is_refused(self):
        path = self.folder / "scene.glb"
        path.write_bytes(scene("steps").read_bytes())
        self.make("compare", path, *COMPARED[2:], "--no-cost")
        path.write_bytes(scene("posts").read_bytes())
        self.assertIn("is not as it was when the plan was made", self.refuse("work", self.plan))
        self.assertFalse((self.folder / "sweep.results").exists())

    def test_a_shader_that_was_added_is_refused(self):
        glsl = self.folder / "glsl"
        glsl.mkdir()
        self.assertIn("no shader to plan with",
                      self.refuse("plan", "compare", *COMPARED, "--no-cost", "--glsl", glsl, "-o", self.plan))
        (glsl / "a.glsl").write_text("// one\n")
        self.make("compare", *COMPARED, "--no-cost", "--glsl", glsl)
        (glsl / "notes.txt").write_text("of the user's\n")
        self.work("--item", "0")
        shader = glsl / "lib" / "octahedral.glsl"
        shader.parent.mkdir()
        shader.write_bytes((ROOT / "glsl" / "lib" / "octahedral.glsl").read_bytes())
        self.assertIn("lib/octahedral.glsl' was not there when the plan was made: plan again", self.refuse("work", self.plan))

    def test_shaders_in_folders_that_are_links_count(self):
        glsl, real = self.folder / "glsl", self.folder / "real"
        for folder in (glsl, real):
            folder.mkdir()
        (glsl / "a.glsl").write_text("// one\n")
        (real / "disc.glsl").write_bytes((ROOT / "glsl" / "lib" / "disc.glsl").read_bytes())
        (glsl / "lib").symlink_to(real)
        (real / "loop").symlink_to(glsl)
        self.make("compare", *COMPARED, "--no-cost", "--glsl", glsl)
        self.work("--item", "0")
        (real / "disc.glsl").write_text("changed")
        self.assertIn("lib/disc.glsl' is not as it was when the plan was made", self.refuse("work", self.plan))

    def test_results_that_cannot_be_written_are_told_before_anything_is_drawn(self):
        cache = self.folder / "cache"
        self.make("compare", scene("steps"), "--technique", "hard", "--spp", "8", *TINY, *SMALL_MAPS, "--no-cost", "--cache", cache)
        self.assertIn("cannot write", self.refuse("work", self.plan, "--results", "/proc/none"))
        self.assertFalse(cache.exists())

    def test_files_that_a_scene_names_and_does_not_use_may_be_missing(self):
        """And a name with a percent sign may be meant as it is written, as `render` takes it."""
        (self.folder / "a%20b.bin").write_bytes(struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0))
        path = self.folder / "scene.gltf"
        path.write_text(json.dumps({
            "asset": {"version": "2.0"}, "nodes": [{"mesh": 0}], "buffers": [{"byteLength": 36, "uri": "a%20b.bin"}],
            "bufferViews": [{"buffer": 0, "byteLength": 36}], "images": [{"uri": "nowhere.png"}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}]}))
        self.make("render", path, *TINY, "--technique", "hard")
        files = [pathlib.Path(file["path"]).name for file in self.document()["scenes"][0]["files"]]
        self.assertEqual(sorted(files), ["a%20b.bin", "scene.gltf"])

    def test_files_that_render_would_not_read_are_not_planned(self):
        folder = self.folder / "scene"
        (folder / "sub").mkdir(parents=True)
        (self.folder / "outside.png").write_bytes(b"of somebody else")
        (folder / "link.png").symlink_to(self.folder / "outside.png")
        (folder / "unused.png").write_bytes(b"no picture")
        (folder / "a.bin").write_bytes(struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0))
        path = folder / "scene.gltf"
        images = ("/etc/passwd", "../outside.png", "%2e%2e/outside.png", "link.png", "sub", "unused.png")
        path.write_text(json.dumps({
            "asset": {"version": "2.0"}, "nodes": [{"mesh": 0}], "buffers": [{"byteLength": 36, "uri": "a.bin"}],
            "bufferViews": [{"buffer": 0, "byteLength": 36}], "images": [{"uri": uri} for uri in images],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}]}))

        def planned(*options):
            self.make("render", path, *TINY, "--technique", "hard", *options)
            return sorted(file["path"] for file in self.document()["scenes"][0]["files"])

        inside = [str(folder / name) for name in ("a.bin", "scene.gltf", "unused.png")]
        self.assertEqual(planned(), inside)
        self.assertEqual(planned("--follow-links"), sorted([*inside, str(folder / "link.png")]))

    def test_names_that_are_not_text_are_refused(self):
        name = self.folder / os.fsdecode(b"\xff.glb")
        name.write_bytes(scene("steps").read_bytes())
        self.assertIn("which is not UTF-8", self.refuse("plan", "render", name, "-o", self.plan, errors="replace"))

    def test_another_folder_for_results_and_other_threads(self):
        other = self.folder / "elsewhere" / "deep"
        self.succeed("work", self.plan, "--results", other, "--item", "0", "--threads", "1")
        self.work("--item", "0", "--threads", "2")
        found = {path.name: path.read_bytes() for path in other.rglob("*.result")}
        self.assertEqual(found, {pathlib.Path(name).name: data for name, data in self.results().items()})

    def test_other_threads_for_times_are_refused(self):
        self.make("compare", *COMPARED)
        self.assertIn("times depend on --threads", self.refuse("work", self.plan, "--item", "0", "--threads", "1"))

    def test_the_output_among_short_flags_is_refused(self):
        self.assertIn("-qo: a plan's -o stands alone",
                      self.refuse("plan", "compare", *COMPARED, "-qo", self.plan, code=2))

    def test_threads_in_either_spelling(self):
        for threads in (["--threads", "2"], ["--threads=2"]):
            self.make("compare", *COMPARED, "--no-cost", *threads)
            self.work("--item", "0", "--threads", "1")
            self.work("--item", "0")

    def test_a_merge_overwrites_nothing_that_it_reads(self):
        report = self.folder / "report"
        report.mkdir()
        self.work()
        plan = report / "results.json"
        plan.write_bytes(self.plan.read_bytes())
        before = self.contents("report")
        error = self.refuse("merge", plan, "--results", self.folder / "sweep.results", "-o", report, code=2)
        self.assertIn(f"-o would overwrite the plan '{plan}'", error)
        self.assertEqual(self.contents("report"), before)
        # A picture that a scene refers to.
        document = self.document()
        document["scenes"][0]["files"].append(dict(document["scenes"][0]["files"][0], path=str(report / "index.html")))
        self.plan.write_text(json.dumps(document))
        self.assertIn(f"-o would overwrite the scene's file '{report / 'index.html'}'",
                      self.refuse("merge", self.plan, "-o", report, code=2))
        self.assertEqual(self.contents("report"), before)

    def test_a_merge_of_pictures_does_not_overwrite_a_scene(self):
        self.make("render", scene("steps"), *TINY, "--set", "cascades.size=256", "--frames", "0:1")
        self.work()
        frame = self.folder / "frame_0001.png"
        frame.write_text("a texture")
        document = self.document()
        document["scenes"][0]["files"].append(dict(document["scenes"][0]["files"][0], path=str(frame)))
        self.plan.write_text(json.dumps(document))
        self.assertIn("frame_0001.png", self.refuse("merge", self.plan, "-o", self.folder, code=2))
        self.assertEqual(frame.read_text(), "a texture")
        self.assertFalse((self.folder / "frame_0000.png").exists())

    def test_an_array_task_is_an_item(self):
        environment = {**os.environ, "SLURM_ARRAY_TASK_ID": "2"}
        self.assertEqual(self.work(env=environment), "1 done, 0 there already, 0 failed\n")
        self.assertTrue(self.file(2).exists())
        self.assertEqual(self.work("--item", "1", env=environment), "1 done, 0 there already, 0 failed\n")
        self.assertTrue(self.file(1).exists())
        bad = self.refuse("work", self.plan, code=2, env={**os.environ, "SLURM_ARRAY_TASK_ID": "two"})
        self.assertIn("SLURM_ARRAY_TASK_ID", bad)

    def test_items_that_are_not_there(self):
        self.assertIn("its items are 0 to 5", self.refuse("work", self.plan, "--item", "6"))
        self.assertIn("--items", self.refuse("work", self.plan, "--items", "3", code=2))

    def test_the_end_by_a_signal_leaves_nothing_half_written(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            process = subprocess.Popen([PROGRAM, "work", self.plan], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
            wait_until_it_catches(number, process)
            process.send_signal(number)
            process.communicate(timeout=60)
            self.assertEqual(process.returncode, 128 + number)
            for path in self.contents("sweep.results"):
                self.assertRegex(path, r"^[0-9a-f]{2}/[0-9a-f]{32}\.result$")

    def test_progress_is_for_terminals(self):
        result = run("work", self.plan, "--item", "0")
        self.assertEqual(result.stderr, "")
        self.assertEqual(run("work", self.plan, "--quiet").stdout, "")

    def test_formats(self):
        self.work("--item", "0")
        plan = self.document()
        self.assertEqual([error.message for error in validator("plan").iter_errors(plan)], [])
        line = self.file(0).read_bytes().split(b"\n", 1)[0]
        self.assertEqual([error.message for error in validator("result").iter_errors(json.loads(line))], [])
        shown = self.succeed("plan", "show", self.plan).stdout
        self.assertEqual(dict(line.split() for line in shown.splitlines()),
                         {name: str(value) for name, value in plan["estimate"].items()})


class Script(Plans):
    """scripts/slurm/penumbra.sbatch, with an sbatch that prints what it is asked."""

    def setUp(self):
        super().setUp()
        self.make("render", *SEQUENCE, "--frames", "0:3", "--frames-per-item", 1)
        sbatch = self.folder / "bin" / "sbatch"
        sbatch.parent.mkdir()
        sbatch.write_text('#!/bin/bash\necho "$@"\n')
        sbatch.chmod(0o755)

    def script(self, path=ROOT / "scripts" / "slurm" / "penumbra.sbatch", **variables):
        environment = {name: value for name, value in os.environ.items() if not name.startswith("SLURM_")}
        environment |= {"PATH": f"{self.folder / 'bin'}:{os.environ['PATH']}", "PENUMBRA": PROGRAM, **variables}
        return subprocess.run(["bash", path, self.plan, "1"], capture_output=True, text=True, timeout=60,
                              env=environment)

    def test_it_submits_itself_from_the_shell_of_an_allocation(self):
        for variables in ({}, {"SLURM_JOB_ID": "7"}):
            result = self.script(**variables)
            self.assertEqual(result.stderr, "")
            self.assertIn("--array=0-3 --ntasks=1", result.stdout)

    def test_a_task_of_the_array_draws_its_share(self):
        for results in ({}, {"RESULTS": str(self.folder / "elsewhere")}):
            result = self.script(SLURM_JOB_ID="7", SLURM_ARRAY_TASK_ID="2", **results)
            self.assertEqual((result.returncode, result.stdout, result.stderr), (0, "", ""))
            self.assertEqual(len(list((self.folder / ("elsewhere" if results else "sweep.results")).rglob("*.result"))), 1)

    def test_handed_to_sbatch_it_says_so(self):
        copied = self.folder / "slurm_script"
        copied.write_bytes((ROOT / "scripts" / "slurm" / "penumbra.sbatch").read_bytes())
        result = self.script(copied, SLURM_JOB_ID="7")
        self.assertEqual((result.returncode, result.stdout), (2, ""))
        self.assertRegex(result.stderr, r"^penumbra\.sbatch submits itself: .*, not with sbatch\n$")


if __name__ == "__main__":
    main()
