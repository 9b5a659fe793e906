"""--stats: what was drawn, on what, and what each pass cost."""

import json

from pictures import SMALL, scene
from support import TestCase, main


class Stats(TestCase):
    def stats(self, *arguments, of="posts"):
        path = self.folder / "s.json"
        self.succeed("render", scene(of), "-o", self.folder / "x.png", *SMALL, "--stats", path, *arguments)
        return json.loads(path.read_text())

    def test_fields(self):
        stats = self.stats("--technique", "pcf", "--backend", "osmesa")
        self.assertRegex(stats["version"], r"^Penumbra \d")
        self.assertEqual(stats["scene"], str(scene("posts")))
        self.assertGreater(stats["scene_facts"]["triangles"], 0)
        self.assertEqual((stats["width"], stats["height"], stats["supersample"]), (96, 54, 1))
        self.assertEqual((stats["technique"], stats["backend"]), ("pcf", "osmesa"))
        for field in ("vendor", "renderer", "version", "glsl_version", "software", "limits"):
            self.assertIn(field, stats["device"])
        names = [row["name"] for row in json.loads(self.succeed("list", "params", "--json").stdout)]
        self.assertEqual(list(stats["params"]), names)
        self.assertGreater(stats["target_bytes"], 96 * 54 * 4)
        self.assertGreater(stats["peak_resident_kilobytes"], 0)

    def test_passes_have_costs_that_add_up_to_the_frame(self):
        stats = self.stats("--stats-frames", "5")
        self.assertEqual(stats["measured_frames"], 5)
        self.assertGreater(len(stats["passes"]), 3)
        for row in [*stats["passes"], stats["frame"]]:
            self.assertEqual(row["frames"], 5, row)
            self.assertLessEqual(0, row["min_ms"])
            self.assertLessEqual(row["min_ms"], row["median_ms"])
            self.assertLessEqual(row["median_ms"], row["max_ms"])
        outer = [row for row in stats["passes"] if "/" not in row["name"]]
        self.assertEqual(len({row["name"] for row in stats["passes"]}), len(stats["passes"]))
        # Passes lie inside the frame, one after the other.
        self.assertLessEqual(sum(row["min_ms"] for row in outer), stats["frame"]["max_ms"] + 0.01)

    def test_a_sequence_counts_every_frame_but_the_first(self):
        stats = self.stats("--frames", "0:3", of="moving")
        self.assertEqual((stats["measured_frames"], stats["frame"]["frames"]), (3, 3))
        stats = self.stats("--frames", "3:4", "--warmup", "2", of="moving")
        self.assertEqual(stats["measured_frames"], 2)

    def test_measuring_does_not_change_the_picture(self):
        self.stats("--stats-frames", "3")
        measured = (self.folder / "x.png").read_bytes()
        self.succeed("render", scene("posts"), "-o", self.folder / "y.png", *SMALL)
        self.assertEqual((self.folder / "y.png").read_bytes(), measured)


if __name__ == "__main__":
    main()
