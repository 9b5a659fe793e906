"""diff: figures, limits and heat maps of two pictures, and what it refuses."""

import json
import math
import os
import struct
import subprocess
import zlib

from support import PROGRAM, TestCase, main, read_png, run


def png(path, rows):
    """An 8-bit PNG from rows of pixels, each a tuple of 1 to 4 channels."""
    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    color = {1: 0, 2: 4, 3: 2, 4: 6}[len(rows[0][0])]
    lines = b"".join(b"\0" + bytes(value for pixel in row for value in pixel) for row in rows)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">2I5B", len(rows[0]), len(rows), 8, color, 0, 0, 0))
                     + chunk(b"IDAT", zlib.compress(lines)) + chunk(b"IEND", b""))
    return path


def exr(path, width, height, channels, window=None, tile=None):
    """An uncompressed float EXR; `channels` maps names to lists of width * height values. With `tile`, its header says
    that it has square tiles of that side."""
    def attribute(name, kind, value):
        return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(value)) + value

    names = sorted(channels)
    listed = b"".join(name.encode() + b"\0" + struct.pack("<iB3xii", 2, 0, 1, 1) for name in names) + b"\0"
    box = struct.pack("<4i", 0, 0, width - 1, height - 1)
    header = struct.pack("<2i", 20000630, 2 | (0x200 if tile else 0)) + b"".join((
        attribute("channels", "chlist", listed), attribute("compression", "compression", b"\0"),
        attribute("dataWindow", "box2i", window or box), attribute("displayWindow", "box2i", window or box),
        attribute("lineOrder", "lineOrder", b"\0"), attribute("pixelAspectRatio", "float", struct.pack("<f", 1)),
        attribute("screenWindowCenter", "v2f", bytes(8)), attribute("screenWindowWidth", "float", struct.pack("<f", 1))))
    header += (attribute("tiles", "tiledesc", struct.pack("<2IB", tile, tile, 0)) if tile else b"") + b"\0"
    size = 4 * width * len(names)
    first = len(header) + 8 * height
    table = b"".join(struct.pack("<Q", first + y * (8 + size)) for y in range(height))
    lines = b"".join(struct.pack("<2i", y, size) + b"".join(
        struct.pack(f"<{width}f", *channels[name][y * width:(y + 1) * width]) for name in names) for y in range(height))
    path.write_bytes(header + table + lines)
    return path


def flat(value, width=40, height=30, channels=3):
    return [[(value,) * channels] * width for _ in range(height)]


class Diff(TestCase):
    def setUp(self):
        super().setUp()
        self.grey = png(self.folder / "grey.png", flat(100))
        self.lighter = png(self.folder / "lighter.png", flat(151))
        spotted = flat(100)
        spotted[20][30] = (255, 255, 255)
        self.spotted = png(self.folder / "spotted.png", spotted)

    def figures(self, *arguments):
        return json.loads(self.succeed("diff", *arguments, "--json", "-").stdout)


class Figures(Diff):
    def test_equal_pictures_keep_every_limit(self):
        line = self.succeed("diff", self.grey, self.grey, "--max", "0").stdout
        self.assertEqual(line, "rmse 0, psnr inf dB, bias 0, max 0, p99 0, ssim 1, flip 0\n")
        for metric, limit in (("psnr", "--min=99"), ("ssim", "--min=1"), ("flip", "--max=0"), ("max", "--max=0")):
            self.succeed("diff", self.grey, self.grey, "--metric", metric, limit)
        self.assertEqual(self.figures(self.grey, self.grey)["figures"]["psnr"], "inf")

    def test_a_constant_difference(self):
        told = self.figures(self.lighter, self.grey)
        self.assertEqual((told["width"], told["height"], told["samples"]), (40, 30, 3600))
        for name in ("rmse", "bias", "max", "p99"):
            self.assertAlmostEqual(told["figures"][name], 0.2, places=6)
        self.assertAlmostEqual(told["figures"]["psnr"], 20 * math.log10(5), places=4)
        self.assertAlmostEqual(self.figures(self.grey, self.lighter)["figures"]["bias"], -0.2, places=6)

    def test_past_a_limit(self):
        for metric, limit in (("rmse", "--max=0.19"), ("psnr", "--min=20"), ("bias", "--max=0.1"), ("max", "--max=0"),
                              ("ssim", "--min=0.99"), ("flip", "--max=0.1")):
            with self.subTest(metric):
                error = self.refuse("diff", self.grey, self.lighter, "--metric", metric, limit)
                self.assertIn(metric, error)
                self.assertIn("limit of " + f"{float(limit.split('=')[1]):g}", error)
                self.assertIn("grey.png", error)
        self.succeed("diff", self.grey, self.lighter, "--max", "0.21")
        told = run("diff", self.grey, self.lighter, "--max", "0.1", "--json", "-")
        self.assertEqual(told.returncode, 1)
        self.assertEqual(json.loads(told.stdout)["limit"], {"metric": "rmse", "max": 0.1, "kept": False})

    def test_a_single_channel_has_figures_of_its_penumbra(self):
        ramp = [[(min(255, max(0, 17 * (x - 12))),) for x in range(40)] for _ in range(30)]
        steep = [[(min(255, max(0, 34 * (x - 16))),) for x in range(40)] for _ in range(30)]
        told = self.figures(png(self.folder / "steep.png", steep), png(self.folder / "ramp.png", ramp))
        self.assertAlmostEqual(told["figures"]["penumbra_width_error"], 0.5, places=2)
        self.assertEqual(told["penumbra_samples"], 14 * 30)
        self.assertLess(told["figures"]["psnr_penumbra"], told["figures"]["psnr"])

    def test_penumbrae_without_a_width_are_told(self):
        ramp = png(self.folder / "ramp.png", [[(min(255, max(0, 17 * (x - 12))),) for x in range(40)] for _ in range(30)])
        lit = png(self.folder / "lit.png", flat(255, channels=1))
        figures = self.figures(lit, ramp)["figures"]
        self.assertEqual((figures["penumbra_width_error"], figures["penumbra_width_lost"]), (None, 1))
        self.assertIn("penumbra widths lost 100 %", self.succeed("diff", lit, ramp).stdout)
        self.assertEqual(self.figures(ramp, ramp)["figures"]["penumbra_width_lost"], 0)
        self.assertNotIn("lost", self.succeed("diff", ramp, ramp).stdout)
        self.assertIn("no penumbra of the first", self.refuse("diff", lit, ramp, "--metric", "penumbra_width_error", "--max=1"))
        self.assertNotIn("penumbra_width_lost", self.figures(self.grey, self.grey)["figures"], "of three channels")

    def test_black_is_no_less_than_0_dB_from_white(self):
        black, white = (png(self.folder / f"{value}.png", flat(value)) for value in (0, 255))
        self.assertIn("psnr 0.00 dB", self.succeed("diff", black, white).stdout)

    def test_exr_layers(self):
        shadow, other = [0.25] * 12, [0.5] * 12
        color = {name: [4.0] * 12 for name in "RGB"}
        a = exr(self.folder / "a.exr", 4, 3, {**color, "shadow.V": shadow, "depth.Z": [7.0] * 12})
        b = exr(self.folder / "b.exr", 4, 3, {**color, "shadow.V": other, "depth.Z": [9.0] * 12})
        told = self.figures(a, b, "--layer", "shadow")
        self.assertEqual((told["layer"], told["channels"]), ("shadow", ["V"]))
        self.assertEqual(told["figures"]["bias"], -0.25)
        self.assertIn("flip", told["figures"])
        colors = self.figures(a, b)
        self.assertEqual((colors["channels"], colors["figures"]["rmse"]), (["R", "G", "B"], 0))
        self.assertNotIn("flip", colors["figures"], "linear colours are not what a display shows")
        depth = self.figures(a, b, "--layer", "depth")["figures"]
        self.assertEqual((depth["rmse"], "psnr" in depth), (2, False))
        self.assertIn("'shadow'", self.refuse("diff", a, b, "--layer", "shadwo"))
        self.assertIn("flip", self.refuse("diff", a, b, "--metric", "flip", "--max", "0.1"))
        only = exr(self.folder / "only.exr", 4, 3, {"truth.V": other})
        self.assertEqual(self.figures(only, only)["layer"], "truth")

    def test_a_mask_leaves_pixels_out(self):
        a = exr(self.folder / "a.exr", 4, 3, {"shadow.V": [0.25] * 11 + [math.nan]})
        layers = {"shadow.V": [0.5] * 10 + [7.0, math.inf], "none.V": [0.0] * 12}
        b = exr(self.folder / "b.exr", 4, 3, {**layers, "receiver.V": [1.0] * 10 + [0.0, math.nan],
                                                   "sky.V": [1.0] * 9 + [0.0, math.nan, math.inf]})
        told = self.figures(a, b, "--layer", "shadow", "--mask", "receiver")
        self.assertEqual((told["samples"], told["not_finite"], told["mask"]), (10, 0, "receiver"))
        self.assertEqual(self.figures(a, b, "--layer", "shadow", "--mask", "sky")["samples"], 9)
        self.assertEqual(told["figures"]["max"], 0.25)
        self.assertIn("flip", told["figures"], "what is left out may hold anything")
        heat = self.folder / "heat.png"
        self.succeed("diff", a, b, "--layer", "shadow", "--mask", "receiver", "--heatmap", heat)
        rows = read_png(heat)
        self.assertEqual(rows[2][2:], [(0, 0, 0)] * 2)
        self.assertNotEqual(rows[2][1], (0, 0, 0))
        self.assertIn("no pixel", self.refuse("diff", a, b, "--layer", "shadow", "--mask", "none"))
        self.assertIn("'receiver'", self.refuse("diff", a, b, "--layer", "shadow", "--mask", "reciever"))

    def test_huge_values_are_measured_or_told(self):
        grey = exr(self.folder / "grey.exr", 4, 3, {"V": [0.5] * 12})
        huge = exr(self.folder / "huge.exr", 4, 3, {"V": [0.5] * 11 + [1e30]})
        self.assertAlmostEqual(self.figures(huge, grey)["figures"]["ssim"], 0, delta=1e-3)
        self.assertIn("under the limit", self.refuse("diff", huge, grey, "--metric", "ssim", "--min", "0.5"))
        most = [3e38, -3e38] * 6
        one, other = (exr(self.folder / f"{name}.exr", 4, 3, {"V": most[shift:] + most[:shift]})
                      for name, shift in (("one", 0), ("other", 1)))
        error = self.refuse("diff", one, other, "--metric", "bias", "--max", "1")
        self.assertIn("bias is not a number", error)
        self.assertNotIn("no penumbra", error)

    def test_values_that_are_not_finite_keep_no_limit(self):
        good = exr(self.folder / "good.exr", 4, 3, {"V": [0.5] * 12})
        bad = exr(self.folder / "bad.exr", 4, 3, {"V": [0.5] * 10 + [math.nan, math.inf]})
        told = self.figures(bad, good)
        self.assertEqual((told["not_finite"], told["figures"]["max"]), (2, 1))
        self.assertIn("2 values not finite", self.succeed("diff", bad, good).stdout)
        self.assertIn("not finite", self.refuse("diff", bad, good, "--max", "1"))
        error = self.refuse("diff", good, bad)
        self.assertIn("bad.exr", error)
        self.assertIn("pixel 2,2 is not finite", error)


class HeatMap(Diff):
    def heat(self, *arguments):
        path = self.folder / "heat.png"
        self.succeed("diff", *arguments, "--heatmap", path)
        return read_png(path)

    def test_its_bright_spot_is_where_they_differ(self):
        for metric in ("rmse", "flip"):
            rows = self.heat(self.spotted, self.grey, "--metric", metric)[:30]
            self.assertEqual((len(rows), len(rows[0])), (30, 40))
            brightest = max((sum(rows[y][x]), x, y) for y in range(30) for x in range(40))
            self.assertEqual(brightest[1:], (30, 20), metric)
            self.assertEqual(rows[0][0], (0, 0, 0))
            far = sum(sum(pixel) > 30 for row in rows for pixel in row)
            self.assertLess(far, 2 if metric == "rmse" else 300)

    def test_has_a_legend_below(self):
        wide = flat(0, 200)
        legend = self.heat(png(self.folder / "a.png", wide), png(self.folder / "b.png", flat(100, 200)))[30:]
        self.assertEqual(len(legend), 16)
        colors = [legend[8][x] for x in range(200)]
        self.assertGreater(len(set(colors)), 50)
        self.assertEqual(legend[0][0], (32, 32, 32))

    def test_its_range_is_the_largest_error_or_the_one_that_is_asked_for(self):
        def error_color(*arguments):
            return self.heat(self.lighter, self.grey, *arguments)[0][0]
        self.assertEqual(error_color(), error_color("--heatmap-range", "0.2"), "0.2 is the largest error")
        halves = [sum(error_color("--heatmap-range", f"{0.2 * 2 ** n}")) for n in range(5)]
        self.assertEqual(halves, sorted(set(halves), reverse=True), "the wider the range, the darker an error")
        self.assertEqual(error_color("--heatmap-range", "0.1"), error_color("--heatmap-range", "0.2"), "the last colour")
        self.assertEqual(error_color("--metric", "flip"), error_color("--metric", "flip", "--heatmap-range", "1"))
        self.assertIn("--heatmap", self.refuse("diff", self.lighter, self.grey, "--heatmap-range", "1", code=2))

    def test_the_legend_has_every_figure_of_the_range(self):
        black, grey = png(self.folder / "a.png", flat(0, 200)), png(self.folder / "b.png", flat(100, 200))
        figure, ink = 8, (224, 224, 224)  # pixels from one figure to the next
        for value in ("0.0001", "0.000123", "100000"):
            legend = self.heat(black, grey, "--heatmap-range", value)[30:]
            inked = {x for row in legend for x in range(200) if row[x] == ink}
            left = 200 - 4 - figure * len(value)
            for place, character in enumerate(value):
                with self.subTest(value=value, place=place):
                    self.assertTrue(inked & set(range(left + figure * place, left + figure * (place + 1))), character)
        for value in ("0.00009", "100001"):
            told = self.refuse("diff", black, grey, "--heatmap", self.folder / "x.png", "--heatmap-range", value, code=2)
            self.assertIn("a number from 0.0001 to 100000", told)

    def test_a_narrow_picture_has_one_too(self):
        thin = png(self.folder / "thin.png", flat(100, 1, 1))
        self.assertEqual(len(self.heat(thin, thin)), 17)


class Refusals(Diff):
    def broken(self, name, data):
        path = self.folder / name
        path.write_bytes(data)
        before = sorted(self.folder.iterdir())
        for pair in ((path, self.grey), (self.grey, path)):
            error = self.refuse("diff", *pair, "--heatmap", self.folder / "heat.png", "--json", self.folder / "x.json")
            self.assertIn(f"'{path}'", error)
        self.assertEqual(sorted(self.folder.iterdir()), before)
        return error

    def test_files_that_are_no_pictures(self):
        self.assertIn("not found", self.refuse("diff", self.folder / "no.png", self.grey))
        self.assertIn("regular file", self.refuse("diff", self.folder, self.grey))
        self.assertIn("empty", self.broken("empty.png", b""))
        self.assertIn("neither PNG nor EXR", self.broken("text.png", b"picture"))

    def test_truncated_files(self):
        whole = self.grey.read_bytes()
        for size in (8, 30, len(whole) // 2, len(whole) - 1):
            self.assertIn("PNG", self.broken("cut.png", whole[:size]))
        whole = exr(self.folder / "whole.exr", 4, 3, {"V": [0.5] * 12}).read_bytes()
        for size in (4, 9, 100, 300, len(whole) - 60, len(whole) - 1):
            self.broken("cut.exr", whole[:size])

    def test_a_damaged_png_is_one_line(self):
        # The compressed data is damaged, and the chunk's checksum fits it: libpng finds it, and would print it.
        whole = self.grey.read_bytes()
        at = whole.index(b"IDAT")
        size = struct.unpack(">I", whole[at - 4:at])[0]
        body = whole[at:at + 4] + bytes(4) + whole[at + 8:at + 4 + size]
        data = whole[:at] + body + struct.pack(">I", zlib.crc32(body)) + whole[at + 8 + size:]
        (self.folder / "bad.png").write_bytes(data)
        result = run("diff", self.grey, self.folder / "bad.png")
        self.assertEqual(result.returncode, 1)
        self.assertRegex(result.stderr, r"^error: cannot read '\S+bad\.png': [^\n]+\n$")

    def test_headers_that_ask_for_much(self):
        huge = struct.pack("<4i", 0, 0, 99_999, 99_999)
        exr(self.folder / "huge.exr", 4, 3, {"V": [0.5] * 12}, window=huge)
        self.assertIn("100000 x 100000", self.refuse("diff", self.folder / "huge.exr", self.grey))
        exr(self.folder / "none.exr", 4, 3, {"V": [0.5] * 12}, window=struct.pack("<4i", 0, 0, -1, 5))
        self.assertIn("without pixels", self.refuse("diff", self.folder / "none.exr", self.grey))
        exr(self.folder / "tile.exr", 4, 3, {"V": [0.5] * 12}, tile=16384)
        self.assertIn("4 x 3 pixels with tiles of 268435456 pixels",
                      self.refuse("diff", self.folder / "tile.exr", self.grey))
        big = b"IHDR" + struct.pack(">2I5B", 99_999, 99_999, 8, 2, 0, 0, 0)
        data = self.grey.read_bytes()
        self.assertIn("99999 x 99999", self.broken("huge.png", data[:12] + big + struct.pack(">I", zlib.crc32(big))
                                                   + data[33:]))

    def test_the_limit_of_pixels_can_be_chosen(self):
        self.succeed("diff", self.grey, self.grey, "--max-pixels", "1200")
        error = self.refuse("diff", self.grey, self.grey, "--max-pixels", "1199")
        self.assertIn("40 x 30 pixels, over the limit of 1199", error)

    def test_pictures_that_do_not_match(self):
        small = png(self.folder / "small.png", flat(100, 39))
        error = self.refuse("diff", self.grey, small)
        self.assertIn("40 x 30", error)
        self.assertIn("39 x 30", error)
        self.assertIn("size", error)
        one = png(self.folder / "one.png", flat(100, channels=1))
        self.assertIn("channels", self.refuse("diff", self.grey, one))
        linear = exr(self.folder / "linear.exr", 40, 30, {name: [0.5] * 1200 for name in "RGB"})
        self.assertIn("linear", self.refuse("diff", self.grey, linear))
        self.assertIn("opaque", self.refuse("diff", png(self.folder / "alpha.png", flat(100, channels=4)), self.grey))
        self.succeed("diff", png(self.folder / "solid.png", [[(100, 100, 100, 255)] * 40] * 30), self.grey, "--max", "0")

    def test_wrong_usage(self):
        for arguments, told in ((["--metric", "flop"], "'flip'"), (["--max", "x"], "--max"), (["--max=-1"], "--max"),
                                (["--min", "1"], "--max"), (["--metric", "psnr", "--max", "1"], "--min"),
                                (["--heatmap", "x.jpg"], ".png"), (["--heatmap", self.grey], "overwrite"),
                                (["--json", self.lighter], "overwrite"), (["--json", ""], "empty"),
                                (["--heatmap", ""], "empty"), (["--mask", ""], "empty"), (["--layer", ""], "empty"),
                                (["--tolerance", "1"], "--tolerance"),
                                (["--heatmap", self.folder / "a.png", "--json", self.folder / "a.png"], "same file")):
            self.assertIn(told, self.refuse("diff", self.grey, self.lighter, *arguments, code=2))
        self.assertIn("B", self.refuse("diff", self.grey, code=2))
        self.assertEqual(len(list(self.folder.iterdir())), 3)

    def test_results_that_cannot_be_written(self):
        for option in ("--heatmap", "--json"):
            path = self.grey / "x.png"
            self.assertIn(f"'{path}'", self.refuse("diff", self.grey, self.lighter, option, path))
        if os.path.exists("/dev/full"):
            with open("/dev/full", "w") as full:
                code = subprocess.run([PROGRAM, "diff", self.grey, self.grey], stdout=full, stderr=subprocess.DEVNULL)
            self.assertEqual(code.returncode, 1)
        self.assertEqual(len(list(self.folder.iterdir())), 3)


if __name__ == "__main__":
    main()
