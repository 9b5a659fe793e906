"""Where the sun is: below the horizon of a scene that stands on ground, it lights nothing."""

import base64
import json
import struct

from pictures import SMALL_MAPS, read_exr, read_png, scene
from support import TestCase, main

SIZE = ("--size", "320x180")


def upright_square(path):
    """Writes a scene of one square that faces +Z, and no floor."""
    corners = struct.pack("<12f", -1, 0, 0, 1, 0, 0, 1, 2, 0, -1, 2, 0)
    data = corners + struct.pack("<6H", 0, 1, 2, 0, 2, 3)
    path.write_text(json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [-1, 0, 0],
                       "max": [1, 2, 0]},
                      {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12}],
        "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64," +
                     base64.b64encode(data).decode()}]}))
    return path


class Horizon(TestCase):
    def lit(self, of, *arguments):
        """The brightest pixel of the sun's shadow picture, and what was printed as a warning."""
        result = self.succeed("render", of, "-o", self.folder / "x.png", *SIZE, *SMALL_MAPS, "--aov", "shadow", "--quiet",
                              *arguments)
        return max(max(row) for row in read_png(self.folder / "x.shadow.png")[3]), result.stderr

    def test_a_sun_below_it_lights_nothing(self):
        for name in ("posts", "courtyard"):
            for technique in (["pcss"], ["slices_denoised"], ["truth", "--no-cache", "--set", "truth.samples=8"]):
                with self.subTest(scene=name, technique=technique[0]):
                    most, warnings = self.lit(scene(name), "--sun", "40,-10", "--technique", *technique)
                    self.assertEqual(most, 0)
                    self.assertEqual(len(warnings.splitlines()), 1, warnings)
                    self.assertIn("below the horizon", warnings)

    def test_rays_see_none_of_it_either(self):
        """`truth` writes what `render` does, whatever the cache holds of the same scene without ground."""
        square = upright_square(self.folder / "square.gltf")
        view = ("--sun", "0,-10", "--eye", "0,1,4", "--target", "0,1,0", *SIZE, "--quiet", "--cache",
                self.folder / "cache")
        for ground, lit in (("off", 1), ("on", 0), ("off", 1)):
            with self.subTest(ground=ground):
                self.succeed("truth", square, "-o", self.folder / "x.exr", "--spp", "8", *view, "--ground", ground)
                layers = read_exr(self.folder / "x.exr")
                for name in ("shadow.V", "hard.V"):
                    self.assertEqual(max(max(row) for row in layers[name]), lit, name)
        for name in ("posts", "courtyard"):
            with self.subTest(scene=name):
                self.succeed("truth", scene(name), "-o", self.folder / "x.png", "--spp", "8", *view)
                self.assertEqual(max(max(row) for row in read_png(self.folder / "x.png")[3]), 0)

    def test_one_that_is_partly_above_it_does(self):
        most, warnings = self.lit(scene("posts"), "--sun", "40,-0.4", "--sun-angle", "2", "--technique", "pcss")
        self.assertGreater(most, 0)
        self.assertEqual(warnings, "")

    def test_there_is_none_without_ground(self):
        square = upright_square(self.folder / "square.gltf")
        below = ("--sun", "0,-10", "--technique", "pcss", "--eye", "0,1,4", "--target", "0,1,0")
        self.assertEqual(self.lit(square, *below, "--ground", "off"), (255, ""))
        most, warnings = self.lit(square, *below, "--ground", "on")
        self.assertEqual(most, 0)
        self.assertIn("light 'sun' is below the horizon", warnings)

    def test_other_lights_are_not_outshone_by_its_sky(self):
        """The lamps of a room look the same whether the sun has set or was left out."""
        pictures = []
        for arguments in (("--sun", "40,-10"), ("--no-sun",)):
            self.succeed("render", scene("gallery"), "-o", self.folder / "x.png", *SIZE, *SMALL_MAPS, "--quiet",
                         *arguments)
            pictures.append(read_png(self.folder / "x.png")[3])
        self.assertEqual(*pictures)

    def test_compare_warns_once(self):
        result = self.succeed("compare", scene("posts"), "-o", self.folder / "report", "--size", "32x18", "--sun", "40,-10",
                              *SMALL_MAPS, "--technique", "hard,pcf", "--reference", "brute_force", "--no-cost", "--quiet")
        self.assertEqual(result.stderr.count("below the horizon"), 1, result.stderr)

    def test_a_sequence_warns_once(self):
        result = self.succeed("render", scene("moving"), "-o", self.folder / "x.png", "--size", "32x18", "--frames",
                              "0:2", *SMALL_MAPS, "--sun", "40,-10", "--quiet")
        self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)


if __name__ == "__main__":
    main()
