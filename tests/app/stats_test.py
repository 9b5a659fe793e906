"""--stats: what was drawn, on what, and what each pass cost."""

import json

from pictures import SMALL, SMALL_MAPS, scene
from support import TestCase, main


class Stats(TestCase):
    def stats(self, *arguments, of="posts", size=(*SMALL, *SMALL_MAPS)):
        path = self.folder / "s.json"
        self.succeed("render", scene(of), "-o", self.folder / "x.png", *size, "--stats", path, *arguments)
        return json.loads(path.read_text())

    def test_fields(self):
        stats = self.stats("--technique", "pcf", "--backend", "osmesa")
        self.assertRegex(stats["version"], r"^Penumbra \d")
        self.assertEqual(stats["scene"], str(scene("posts")))
        self.assertGreater(stats["scene_facts"]["triangles"], 0)
        self.assertEqual((stats["width"], stats["height"], stats["supersample"], stats["samples"]), (96, 54, 1, 4))
        self.assertEqual((stats["technique"], stats["backend"]), ("pcf", "osmesa"))
        for field in ("vendor", "renderer", "version", "glsl_version", "software", "limits"):
            self.assertIn(field, stats["device"])
        names = [row["name"] for row in self.listed("params")]
        self.assertEqual(list(stats["params"]), names)
        self.assertGreater(stats["target_bytes"], 96 * 54 * 4)
        self.assertGreater(stats["peak_resident_kilobytes"], 0)

    def test_the_view_can_be_drawn_by_another_renderer(self):
        stats = self.stats("--technique", "none", "--eye", "0,2,5", "--target", "0,2,0", "--fov", "40", "--sun", "90,0",
                           "--ground", "on")
        camera = stats["camera"]
        for name, expected in {"eye": (0, 2, 5), "forward": (0, 0, -1), "up": (0, 1, 0)}.items():
            for value, wanted in zip(camera[name], expected, strict=True):
                self.assertAlmostEqual(value, wanted, places=5)
        self.assertAlmostEqual(camera["fov_y_degrees"], 40, places=4)
        self.assertGreater(camera["near"], 0)
        for value, wanted in zip(stats["sun_to_light"], (1, 0, 0), strict=True):
            self.assertAlmostEqual(value, wanted, places=5)
        self.assertEqual(len({tuple(corner) for corner in stats["ground"]}), 4)
        self.assertEqual(len({corner[1] for corner in stats["ground"]}), 1)  # level
        self.assertIsNone(self.stats("--technique", "none", "--ground", "off")["ground"])

    def test_maps_are_drawn_anew_where_a_picture_is_measured(self):
        stats = self.stats("--stats-frames", "2")
        self.assertEqual(stats["maps"], "drawn anew in every frame")
        self.assertIn("shadow map", {row["name"] for row in stats["passes"] if row["min_ms"] > 0})

    def test_passes_have_costs_that_add_up_to_the_frame(self):
        stats = self.stats("--stats-frames", "5")
        self.assertEqual(stats["measured_frames"], 5)
        self.assertGreater(len(stats["passes"]), 3)
        for row in [*stats["passes"], stats["frame"]]:
            self.assertEqual(row["frames"], 5, row)
            self.assertLessEqual(0, row["min_ms"])
            self.assertLessEqual(row["min_ms"], row["median_ms"])
            self.assertLessEqual(row["median_ms"], row["max_ms"])
        self.assertEqual(len({row["name"] for row in stats["passes"]}), len(stats["passes"]))
        # Passes lie inside the frame, one after the other.
        outer = [row for row in stats["passes"] if "/" not in row["name"]]
        self.assertLessEqual(sum(row["min_ms"] for row in outer), stats["frame"]["max_ms"] + 0.01)

    def test_the_table_names_every_pass_and_no_other(self):
        always = ["depth", "gbuffer", "shadow mask", "lighting", "sky", "exposure"]
        samples = ["sample depth", "sample gbuffer", "sample lighting", "sample sky", "add sample", "encode mean"]
        for of, arguments, more in (
            ("posts", ["--technique", "none"], []),
            ("posts", ["--technique", "hard"], ["shadow map"]),
            ("posts", ["--technique", "pcss", "--set", "mask.tiles=off"], ["shadow map", "depth pyramid"]),
            ("posts", ["--technique", "pcss"], ["shadow map", "depth pyramid", "tile decisions"]),
            ("posts", ["--technique", "pcss_compute"],
             ["shadow map", "depth pyramid", "tile decisions", "decided tiles"]),
            ("moving", ["--technique", "hard", "--frames", "0:2"], ["deform", "shadow map"]),
        ):
            for count, shown in (("1", ["tone map"]), ("3", samples)):
                with self.subTest(f"{of} {arguments} {count}"):
                    names = [row["name"] for row in self.stats(*arguments, "--samples", count, of=of)["passes"]]
                    self.assertEqual(sorted(names), sorted(always + shown + more))

    def test_a_sequence_counts_every_frame_but_the_first(self):
        stats = self.stats("--frames", "0:3", of="moving")
        self.assertEqual((stats["measured_frames"], stats["frame"]["frames"]), (3, 3))
        stats = self.stats("--frames", "3:4", "--warmup", "2", of="moving")
        self.assertEqual(stats["measured_frames"], 2)

    def test_measuring_does_not_change_the_picture(self):
        self.stats("--stats-frames", "3")
        measured = (self.folder / "x.png").read_bytes()
        self.succeed("render", scene("posts"), "-o", self.folder / "y.png", *SMALL, *SMALL_MAPS)
        self.assertEqual((self.folder / "y.png").read_bytes(), measured)


if __name__ == "__main__":
    main()
