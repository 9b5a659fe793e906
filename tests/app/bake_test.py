"""bake: noise tiles, keys and sample points are the same for the same command, and what it refuses leaves no file."""

import json
import os
import pty
import subprocess

from support import PROGRAM, ROOT, TestCase, main, read_png

EMBEDDED = ROOT / "src" / "shadow" / "noise"
NOWHERE = "/dev/null/tile.exr"  # faults of the command line are reported before faults of files


class Noise(TestCase):
    def bake(self, name, *arguments):
        path = self.folder / name
        said = self.succeed("bake", "noise", "-o", path, *arguments).stdout
        return path.read_bytes(), said

    def test_the_same_command_gives_the_same_bytes(self):
        # Each kind, and each extension once: how noise is made does not depend on where it is written to.
        for kind, extension in (("white", "exr"), ("white", "png"), ("blue", "u16"), ("void_and_cluster", "u16"),
                                ("spatiotemporal", "exr")):
            command = ("--kind", kind, "--size", "16", "--seed", "7")
            first, _ = self.bake(f"a.{extension}", *command, "--threads", "1")
            again, _ = self.bake(f"b.{extension}", *command, "--threads", "3")
            self.assertEqual(first, again, f"{kind} {extension}")
            other, _ = self.bake(f"c.{extension}", "--kind", kind, "--size", "16", "--seed", "8")
            self.assertNotEqual(first, other, f"{kind} {extension}")

    def test_the_tile_that_the_library_embeds_is_what_the_command_makes(self):
        baked, said = self.bake("tile.u16", "--kind", "void_and_cluster")
        self.assertEqual(baked, (EMBEDDED / "void_and_cluster.u16").read_bytes())
        self.assertRegex(said, r"void_and_cluster noise, 64 × 64, power of low over high frequencies 0\.000\d+ 0\.000\d+")

    def test_a_picture_shows_each_level_as_often(self):
        self.bake("tile.png", "--kind", "white", "--size", "16", "--channels", "1")
        levels = sorted(pixel[0] for row in read_png(self.folder / "tile.png") for pixel in row)
        self.assertEqual(levels, list(range(256)))

    def test_progress_is_a_share_and_the_time_left_on_a_terminal_alone(self):
        command = ("bake", "noise", "-o", self.folder / "tile.png", "--size", "16")
        self.assertEqual(self.succeed(*command).stderr, "")
        terminal, end = pty.openpty()
        subprocess.run([PROGRAM, *map(str, command)], stdout=subprocess.DEVNULL, stderr=end, check=True, timeout=300)
        os.close(end)
        shown = os.read(terminal, 1 << 16).decode()
        os.close(terminal)
        self.assertRegex(shown, r"^\r1 %, \d+:\d\d left\x1b\[K\r2 %, ")
        self.assertTrue(shown.endswith("\r100 %, 0:00 left\x1b[K\r\x1b[K"), shown[-60:])

    def test_refuses_what_it_cannot_make(self):
        path = self.folder / "tile.exr"
        for option, value in (("--size", "24"), ("--size", "512"), ("--kind", "pink"), ("--channels", "4"),
                              ("--seed", "x"), ("--threads", "-1")):
            error = self.refuse("bake", "noise", "-o", path, option, value, code=2)
            self.assertIn(value, error)
            self.assertEqual(self.refuse("bake", "noise", "-o", NOWHERE, option, value, code=2), error)
        self.assertIn(".txt", self.refuse("bake", "noise", "-o", self.folder / "tile.txt", code=2))
        self.assertIn("64", self.refuse("bake", "noise", "--kind", "spatiotemporal", "--size", "80", "-o", path, code=2))
        self.assertIn("noise, keys, points", self.refuse("bake", code=2))
        self.assertEqual(list(self.folder.iterdir()), [])


class Keys(TestCase):
    def test_the_same_command_gives_the_same_bytes(self):
        baked = []
        for name, seed in (("a.u16", "7"), ("b.u16", "7"), ("c.u16", "8")):
            said = self.succeed("bake", "keys", "--size", "16", "--seed", seed, "-o", self.folder / name).stdout
            self.assertRegex(said, r"keys, 16 × 16, .* 0\.\d+ with 1 samples")
            baked.append((self.folder / name).read_bytes())
        self.assertEqual(len(baked[0]), 16 * 16 * 3 * 2)
        self.assertEqual(baked[0], baked[1])
        self.assertNotEqual(baked[0], baked[2])

    def test_refuses_what_it_cannot_make(self):
        for name, size in (("a.u16", "24"), ("a.u16", "512"), ("a.png", "16")):
            self.refuse("bake", "keys", "--size", size, "-o", self.folder / name, code=2)
        self.assertEqual(list(self.folder.iterdir()), [])


class Points(TestCase):
    def test_csv_and_json_hold_the_same_points(self):
        csv, js = self.folder / "points.csv", self.folder / "points.json"
        said = self.succeed("bake", "points", "--pattern", "hammersley", "--count", "4", "-o", csv).stdout
        self.assertIn("star discrepancy", said)
        self.succeed("bake", "points", "--pattern", "hammersley", "--count", "4", "-o", js, "--quiet")
        rows = csv.read_text().splitlines()
        self.assertEqual(rows[0], "x,y")
        listed = [tuple(map(float, row.split(","))) for row in rows[1:]]
        self.assertEqual(listed, [(0.125, 0.125), (0.375, 0.625), (0.625, 0.375), (0.875, 0.875)])
        self.assertEqual(listed, [tuple(point) for point in json.loads(js.read_text())["points"]])

    def test_refuses_what_it_cannot_make(self):
        path = self.folder / "points.csv"
        self.assertIn("poisson", self.refuse("bake", "points", "-o", path, "--pattern", "poison", code=2))
        self.assertIn("--count", self.refuse("bake", "points", "-o", path, "--count", "0", code=2))
        self.assertEqual(list(self.folder.iterdir()), [])


if __name__ == "__main__":
    main()
