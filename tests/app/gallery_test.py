"""The scene `gallery`: its lamps, what the sun reaches in it, and lamps that their housings leave free."""

import json
import math
import struct

from pictures import read_exr, scene
from support import TestCase, main

GALLERY = scene("gallery")
FULL = 0.999


def document(path):
    """The JSON of a .glb file."""
    data = path.read_bytes()
    length, kind = struct.unpack_from("<II", data, 12)
    assert kind == 0x4E4F534A, "no JSON first"
    return json.loads(data[20:20 + length])


def lamp_of(root, name):
    """A light, its position, and the direction in which it shines."""
    lights = root["extensions"]["KHR_lights_punctual"]["lights"]
    number = [light["name"] for light in lights].index(name)
    for node in root["nodes"]:
        if node.get("extensions", {}).get("KHR_lights_punctual", {}).get("light") == number:
            x, y, z, w = node.get("rotation", (0, 0, 0, 1))
            shines = (-2 * (x * z + y * w), -2 * (y * z - x * w), -1 + 2 * (x * x + y * y))
            return lights[number], node["translation"], shines
    raise AssertionError(f"no node holds {name}")


class Gallery(TestCase):
    def trace(self, *arguments):
        path = self.folder / "x.exr"
        self.succeed("truth", GALLERY, "-o", path, "--no-cache", "--quiet", *arguments)
        return read_exr(path)

    def test_lights(self):
        facts = json.loads(self.succeed("info", GALLERY, "--json").stdout)
        self.assertEqual({light["name"]: (light["kind"], light["unit"]) for light in facts["lights"]},
                         {"sun": ("directional", "lx"), "sculpture spot": ("spot", "cd"),
                          "picture spot": ("spot", "cd"), "pendant": ("point", "cd")})
        self.assertLess(facts["triangles"], 60000)
        root = document(GALLERY)
        for name, radius in (("sculpture spot", 0.04), ("picture spot", 0.04), ("pendant", 0.08)):
            self.assertEqual(lamp_of(root, name)[0]["extras"], {"radius": radius})

    def test_size_of_the_room(self):
        bounds = json.loads(self.succeed("info", GALLERY, "--json").stdout)["bounds"]
        # 9 × 3.6 × 6 m within walls and a ceiling of 0.3 m; a slab of 0.25 m lies below.
        for axis, size in enumerate((9.6, 0.25 + 3.6 + 0.3, 6.6)):
            self.assertAlmostEqual(bounds["max"][axis] - bounds["min"][axis], size, delta=1e-4)

    def test_the_sun_falls_in_over_the_sill(self):
        # The edge that casts is that of the sill: x = -4.456, y = 2.112. The sun is 27° high, 96° west of +Z.
        edge = -4.456 + 2.112 * math.sin(math.radians(96)) / math.tan(math.radians(27))
        half = math.tan(math.radians(20)) * 96 / 54
        row = self.trace(f"--eye={edge},1,-0.6", f"--target={edge},0,-0.6", "--fov", "40", "--size", "96x54",
                         "--spp", "256")["shadow.V"][27]
        self.assertEqual(set(row[:40]), {0.0})
        self.assertGreater(min(row[56:88]), FULL)
        lit = sum(row[:88]) * 2 * half / 96
        self.assertAlmostEqual(lit, (88 / 96 * 2 - 1) * half, delta=0.01)

    def test_the_sun_reaches_no_other_part_of_the_floor(self):
        shadow = self.trace("--eye=0,3,0", "--target=0,0,0", "--fov", "89", "--size", "160x90", "--spp",
                            "16")["shadow.V"]
        pixel = 2 * 3 * math.tan(math.radians(44.5)) / 90
        lit = {(x, z): value for z, row in enumerate(shadow) for x, value in enumerate(row)}
        lit = {((x + 0.5 - 80) * pixel, (z + 0.5 - 45) * pixel): value for (x, z), value in lit.items() if value > 0}
        self.assertGreater(len(lit), 200)
        for x, z in lit:
            # Higher things, such as the screen, are seen further out than where they stand.
            self.assertTrue(-4 < x < 1.3 and -1.3 < z < 2.2, (x, z))

    def test_housings_do_not_shade_their_lamps(self):
        root = document(GALLERY)
        for name in ("sculpture spot", "picture spot", "pendant"):
            with self.subTest(name):
                light, eye, shines = lamp_of(root, name)
                cone = light.get("spot", {}).get("outerConeAngle", math.radians(45))
                if "spot" not in light:
                    shines = (0, -1, 0)
                target = [e + s for e, s in zip(eye, shines)]
                # What the lamp's centre sees: all of it is lit, apart from penumbrae and what faces away at an edge.
                layers = self.trace("--eye=" + ",".join(map(str, eye)), "--target=" + ",".join(map(str, target)),
                                    "--fov", str(2 * math.degrees(cone)), "--size", "64x64", "--spp", "32",
                                    "--lights", name, "--lamp-radius", str(light["extras"]["radius"]))
                inside = [value for y, row in enumerate(layers["shadow.V"]) for x, value in enumerate(row)
                          if math.hypot(x - 31.5, y - 31.5) < 31]
                self.assertGreater(sum(value > FULL for value in inside) / len(inside), 0.85)
                self.assertGreater(sum(inside) / len(inside), 0.93)


if __name__ == "__main__":
    main()
