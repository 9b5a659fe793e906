"""Spots and point lamps on the command line: which lights shine, and what is said of them."""

import json

from pictures import SMALL_MAPS, read_exr, scene
from support import TestCase, main

GALLERY, POSTS = scene("gallery"), scene("posts")
SIZE = ("--size", "64x36")


class Lamps(TestCase):
    def lights(self, path, *arguments):
        stats = self.folder / "stats.json"
        self.succeed("render", path, "-o", self.folder / "x.png", *SIZE, *SMALL_MAPS, "--technique", "hard", "--quiet",
                     "--stats", stats, *arguments)
        return json.loads(stats.read_text())["lights"]

    def kinds(self, *arguments):
        return [light["kind"] for light in self.lights(*arguments)]

    def test_a_file_is_lit_by_its_own_lights(self):
        lights = self.lights(GALLERY)
        self.assertEqual([light["kind"] for light in lights], ["sun", "spot", "spot", "point"])
        self.assertEqual([round(light["radius"], 4) for light in lights[1:]], [0.04, 0.04, 0.08])
        self.assertEqual(self.kinds(POSTS), ["sun"])

    def test_the_user_chooses(self):
        self.assertEqual(self.kinds(GALLERY, "--no-sun"), ["spot", "spot", "point"])
        self.assertEqual(self.kinds(GALLERY, "--lights", "pendant,sun"), ["sun", "point"])
        self.assertEqual(self.kinds(GALLERY, "--lights", "pendant", "--sun", "30,40"), ["sun", "point"])
        self.assertEqual([light["radius"] for light in self.lights(GALLERY, "--lamp-radius", "0.5", "--no-sun")], [0.5] * 3)
        lights = self.lights(POSTS, "--lamp", "0,3,0", "--lamp", "1,3,0:to=0,0,0:cone=30")
        self.assertEqual([light["kind"] for light in lights], ["sun", "point", "spot"])

    def test_a_lamp_shadows_as_rays_do(self):
        lamp = ("--no-sun", "--lamp", "2,6,3:radius=0.15:cd=500")
        masks = {}
        for technique in ("hard", "slices", "truth"):
            path = self.folder / f"{technique}.exr"
            self.succeed("render", POSTS, "-o", path, "--size", "160x90", "--technique", technique, "--aov", "shadow",
                         "--quiet", "--set", "truth.samples=64", "--set", "slices.azimuths=16", "--set", "lamps.size=4096", *lamp)
            masks[technique] = [value for row in read_exr(path)["shadow.V"] for value in row]
        penumbra = [i for i, value in enumerate(masks["truth"]) if 0.1 < value < 0.9]
        self.assertGreater(len(penumbra), 50)

        def error(technique):
            return sum(abs(masks[technique][i] - masks["truth"][i]) for i in penumbra) / len(penumbra)

        self.assertLess(error("slices"), 0.2 * error("hard"))

    def test_a_lamp_shines_within_its_range_alone(self):
        lamp = ("--no-sun", "--lamp", "2,6,3:radius=0.15:cd=500:range=7")
        masks = []
        for technique in ("slices", "truth"):
            path = self.folder / f"{technique}.exr"
            self.succeed("render", POSTS, "-o", path, "--size", "160x90", "--technique", technique, "--aov", "shadow",
                         "--quiet", "--set", "truth.samples=16", *lamp)
            masks.append([value for row in read_exr(path)["shadow.V"] for value in row])
        beyond = sum(value == 0 for value in masks[1])
        self.assertGreater(beyond, 500)
        self.assertLess(sum((x == 0) != (y == 0) for x, y in zip(*masks)), 0.02 * len(masks[0]))

    def test_a_light_that_is_named_twice_shines_once(self):
        self.assertEqual(self.kinds(GALLERY, "--lights", "pendant,pendant,sun"), ["sun", "point"])

    def test_a_lamp_beyond_the_limit_is_left_out(self):
        gltf = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
                "extensionsUsed": ["KHR_lights_punctual"],
                "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "name": "far"}, {"type": "point"}]}},
                "nodes": [{"translation": [1e7, 0, 0], "extensions": {"KHR_lights_punctual": {"light": 0}}},
                          {"translation": [0, 2, 0], "extensions": {"KHR_lights_punctual": {"light": 1}}}]}
        path = self.folder / "far.gltf"
        path.write_text(json.dumps(gltf))
        result = self.succeed("render", path, "-o", self.folder / "far.png", *SIZE, "--technique", "hard")
        self.assertIn("light 'far' is left out: it is more than 1000 km from the origin", result.stderr)
        self.assertIn("nothing lights the scene", self.refuse("render", path, "-o", self.folder / "far.png", *SIZE,
                                                              "--lights", "far"))

    def test_faults_are_one_line(self):
        for arguments, line in ((("--lights", "pendent"), "unknown light 'pendent'; did you mean 'pendant'?"),
                                (("--lights", "pendant", "--technique", "ssss"),
                                 "light 'pendant' is a lamp, and technique 'ssss' is for suns alone"),
                                (("--no-sun", "--sun", "0,45"), "--sun and --no-sun exclude each other"),
                                (("--lamp", "1,2"), "x,y,z in metres"), (("--lights", "a,,b"), "has an empty name"),
                                (("--lamp", "1,2,3:size=4"), "no attribute 'size'")):
            with self.subTest(arguments=arguments):
                message = self.refuse("render", GALLERY, "-o", self.folder / "y.png", *SIZE, *arguments,
                                      code=1 if "technique" in line or "pendant" in line else 2)
                self.assertIn(line, message)
        # Before the reference is traced, which would take long.
        for arguments in (("compare", "--technique", "hard,vssm", "--spp", "4096"), ("reproduce", "--quick")):
            with self.subTest(arguments=arguments):
                message = self.refuse(arguments[0], GALLERY, "-o", self.folder / "y", *arguments[1:], "--no-cache")
                self.assertIn("technique 'vssm' is for suns alone" if arguments[0] == "compare" else
                              "the figures are of a scene that suns alone light, and lamps shine here too", message)
        many = [word for x in range(8) for word in ("--lamp", f"{x},3,0")]
        self.assertIn("48 maps of lamps with lamps.size=4096 are 805306368 texels: the limit is 268435456 (1.2 GiB)",
                      self.refuse("render", POSTS, "-o", self.folder / "y.png", *SIZE, "--no-sun", "--set",
                                  "lamps.size=4096", *many))
        for of, arguments, why in ((POSTS, (), "no other light than a sun shines"),
                                   (GALLERY, ("--lights", "none"), "none of its lights is chosen")):
            self.assertIn(f"nothing lights the scene: {why}",
                          self.refuse("render", of, "-o", self.folder / "y.png", *SIZE, "--no-sun", *arguments))
        self.assertFalse((self.folder / "y.png").exists())


if __name__ == "__main__":
    main()
