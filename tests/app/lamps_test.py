"""Spots and point lamps on the command line: which lights shine, and what is said of them."""

import json

from pictures import read_exr, scene
from support import TestCase, main

GALLERY, POSTS = scene("gallery"), scene("posts")
SIZE = ("--size", "64x36")


class Lamps(TestCase):
    def lights(self, path, *arguments):
        stats = self.folder / "stats.json"
        self.succeed("render", path, "-o", self.folder / "x.png", *SIZE, "--technique", "hard", "--quiet", "--stats", stats,
                     *arguments)
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
        for name, technique in (("a", "slices"), ("b", "truth")):
            self.succeed("render", POSTS, "-o", self.folder / f"{name}.exr", "--size", "160x90", "--technique", technique,
                         "--aov", "shadow", "--quiet", "--set", "truth.samples=64", "--set", "slices.azimuths=16", *lamp)
        drawn, truth = (read_exr(self.folder / f"{name}.exr")["shadow.V"] for name in "ab")
        errors = [abs(x - y) for rows in zip(drawn, truth) for x, y in zip(*rows)]
        self.assertGreater(sum(0.1 < value < 0.9 for row in truth for value in row), 50)
        self.assertLess(sum(errors) / len(errors), 0.01)

    def test_faults_are_one_line(self):
        for arguments, line in ((("--lights", "pendent"), "unknown light 'pendent'; did you mean 'pendant'?"),
                                (("--lights", "pendant", "--technique", "ssss"), "technique 'ssss' is for suns alone"),
                                (("--no-sun", "--sun", "0,45"), "--sun and --no-sun exclude each other"),
                                (("--lamp", "1,2"), "x,y,z in metres"), (("--lights", "a,,b"), "has an empty name"),
                                (("--lamp", "1,2,3:size=4"), "no attribute 'size'")):
            with self.subTest(arguments=arguments):
                message = self.refuse("render", GALLERY, "-o", self.folder / "y.png", *SIZE, *arguments,
                                      code=1 if "technique" in line or "pendant" in line else 2)
                self.assertIn(line, message)
        many = [word for x in range(8) for word in ("--lamp", f"{x},3,0")]
        self.assertIn("48 maps of lamps with lamps.size=4096 are 805306368 texels: the limit is 268435456 (1.1 GiB)",
                      self.refuse("render", POSTS, "-o", self.folder / "y.png", *SIZE, "--no-sun", "--set",
                                  "lamps.size=4096", *many))
        self.assertIn("nothing lights the scene",
                      self.refuse("render", POSTS, "-o", self.folder / "y.png", *SIZE, "--no-sun"))
        self.assertFalse((self.folder / "y.png").exists())


if __name__ == "__main__":
    main()
