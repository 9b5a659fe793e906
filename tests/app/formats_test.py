"""JSON documents that commands write are as their schemas in docs/schemas say, and docs/formats.md lists them all.

That of reproduce is checked by reproduce_test.py, which makes it anyway."""

import json

import jsonschema
from pictures import scene
from schemas import SCHEMAS, SchemaTest
from support import ROOT, main

TINY = ("--size", "64x36", "--set", "cascades.size=256", "--set", "lamps.size=64")


class Formats(SchemaTest):
    def written(self, name):
        return json.loads((self.folder / name).read_text())

    def test_schemas_are_schemas_and_are_listed(self):
        page = (ROOT / "docs" / "formats.md").read_text()
        for path in SCHEMAS.iterdir():
            jsonschema.Draft202012Validator.check_schema(json.loads(path.read_text()))
            self.assertIn(f"(schemas/{path.name})", page)

    def test_render(self):
        for arguments in ([scene("gallery")], [scene("knife_edge"), "--camera", "top", "--no-sun", "--lamp", "1,2,3"],
                          [scene("posts"), "--frames", "0:2", "--ground", "on", "--technique", "thesis"]):
            self.succeed("render", *arguments, "-o", self.folder / "x.png", *TINY, "--stats", self.folder / "x.json")
            self.check("render", self.written("x.json"))

    def test_diff(self):
        a, b = self.folder / "a.exr", self.folder / "b.exr"
        self.succeed("render", scene("posts"), "-o", a, *TINY, "--aov", "shadow", "--technique", "hard")
        self.succeed("render", scene("posts"), "-o", b, *TINY, "--aov", "shadow", "--technique", "pcss")
        for arguments in ([a, b], [a, a, "--layer", "shadow", "--metric", "psnr_penumbra", "--min", "1"],
                          [a, b, "--layer", "shadow", "--mask", "shadow", "--max", "1"]):
            self.check("diff", json.loads(self.succeed("diff", *arguments, "--json", "-").stdout))

    def test_compare(self):
        folder = self.folder / "report"
        for arguments in ([scene("steps"), scene("gallery"), "--technique", "hard,pcss:pcss.filter_taps=4"],
                          [scene("moving"), "--technique", "thesis", "--frames", "0:17", "--orbit", "1"],
                          [scene("posts"), "--technique", "hard", "--frames", "0:33", "--orbit", "1"],
                          [scene("gallery"), "--lights", "sculpture spot", "--technique", "hard"],
                          [scene("knife_edge"), "--camera", "top", "--technique", "hard"]):
            self.succeed("compare", *arguments, "--spp", "8", *TINY, "-o", folder)
            self.check("compare", self.written("report/results.json"))

    def test_bench(self):
        for arguments in (["--technique", "none,pcss", "--floor"], ["--whole-frames"], ["--sweep", "taps"],
                          ["--sweep", "resolution"]):
            self.succeed("bench", scene("steps"), *arguments, *TINY, "--frames", "1", "-o", self.folder / "x.json")
            self.check("bench", self.written("x.json"))

    def test_plan_and_result(self):
        frames = ("--technique", "pcss", "--frames", "0:2", "--frames-per-item", "2")
        for command, *arguments in (["compare", scene("steps"), scene("gallery"), "--technique", "hard", "--spp", "8"],
                                    ["compare", scene("moving"), "--technique", "hard,pcf", "--frames", "0:1", "--no-cost",
                                     "--spp", "8"],
                                    ["render", scene("moving"), *frames], ["truth", scene("steps"), "--spp", "8"],
                                    ["render", scene("gallery"), "--no-sun", "--camera", "0"],
                                    ["bench", scene("steps"), "--technique", "hard", "--floor", "--frames", "1"],
                                    ["bench", "--sweep", "casters", "--frames", "1"]):
            self.succeed("plan", command, *arguments, *TINY, "-o", self.folder / "x.json")
            self.check("plan", self.written("x.json"))
            self.succeed("work", self.folder / "x.json", "--item", "0")
        results = list(self.folder.rglob("*.result"))
        self.assertEqual(len(results), 7)
        for path in results:
            self.check("result", json.loads(path.read_bytes().split(b"\n", 1)[0]))

    def test_info(self):
        for name in ("gallery", "moving", "foliage", "knife_edge"):
            self.check("info", json.loads(self.succeed("info", scene(name), "--json").stdout))

    def test_an_empty_scene(self):
        path = self.folder / "empty.gltf"
        path.write_text(json.dumps({"asset": {"version": "2.0"}}))
        self.check("info", json.loads(self.succeed("info", path, "--json").stdout))

    def test_list(self):
        lists = json.loads(self.succeed("list", "--json").stdout)
        self.check("list", lists)
        for row in lists["rows"]:
            document = json.loads(self.succeed("list", row["name"], "--json").stdout)
            self.check("list", document)
            self.assertEqual(document["list"], row["name"])

    def test_doctor(self):
        self.check("doctor", json.loads(self.succeed("doctor", "--json").stdout))

    def test_points(self):
        for disc in ([], ["--disc"]):
            self.succeed("bake", "points", "--count", "4", *disc, "-o", self.folder / "x.json")
            self.check("points", self.written("x.json"))


if __name__ == "__main__":
    main()
