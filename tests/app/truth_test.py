"""`penumbra truth`: layers, determinism, the cache, lights of the scene, and what it refuses."""

import json
import os
import resource
import signal
import subprocess
import time

from pictures import SMALL, SMALL_MAPS, read_exr, read_exr_header, read_png, scene
from support import PROGRAM, TestCase, main, shader_cache, wait_until_it_catches

FENCE = scene("fence")
LAYERS = {"shadow.V", "standard_error.V", "hard.V", "receiver.V"}


class Truth(TestCase):
    def setUp(self):
        super().setUp()
        self.cache = self.folder / "cache"

    def trace(self, name, *arguments, of=FENCE, size=SMALL):
        result = self.succeed("truth", of, "-o", self.folder / name, *size, "--cache", self.cache, *arguments)
        return result.stdout

    def kept(self):
        return sorted(self.cache.iterdir()) if self.cache.exists() else []

    def test_layers_and_what_they_hold(self):
        self.trace("x.exr", "--spp", "64", "--sun-angle", "3")
        header = read_exr_header(self.folder / "x.exr")
        self.assertEqual(set(header["channels"]), LAYERS)
        self.assertEqual(header["penumbra:technique"], "truth")
        self.assertEqual(header["penumbra:param.truth.samples"], "64")
        layers = read_exr(self.folder / "x.exr")
        pixels = [(s, e, h) for rows in zip(*(layers[n] for n in ("shadow.V", "standard_error.V", "hard.V")))
                  for s, e, h in zip(*rows)]
        self.assertEqual({h for _, _, h in pixels}, {0.0, 1.0})
        self.assertEqual({r for row in layers["receiver.V"] for r in row}, {0.0, 1.0})
        self.assertTrue(all(0 <= s <= 1 and 0 <= e < 0.2 for s, e, _ in pixels))
        penumbra = [(s, e) for s, e, _ in pixels if 0.1 < s < 0.9]
        self.assertGreater(len(penumbra), 50)
        self.assertTrue(any(e > 0 for _, e in penumbra))

    def test_png_is_the_shadow(self):
        self.trace("x.exr")
        self.trace("x.png")
        floats = read_exr(self.folder / "x.exr")["shadow.V"]
        _, _, channels, rows = read_png(self.folder / "x.png")
        self.assertEqual(channels, 1)
        for row, values in zip(rows, floats):
            for byte, value in zip(row, values):
                self.assertAlmostEqual(byte, 255 * value, delta=0.51)

    def test_extensions_may_be_in_capitals(self):
        self.trace("X.PNG", "--spp", "8")
        self.assertEqual((self.folder / "X.PNG").read_bytes()[:4], b"\x89PNG")

    def test_same_bytes_with_any_number_of_threads_and_without_a_cache(self):
        files = []
        for name, more in (("a", ()), ("b", ("--threads", "1")), ("c", ("--backend", "osmesa"))):
            self.succeed("truth", FENCE, "-o", self.folder / f"{name}.exr", *SMALL, "--no-cache", "--quiet", *more)
            files.append((self.folder / f"{name}.exr").read_bytes())
        self.assertEqual(files[0], files[1])
        self.assertEqual(files[0], files[2])
        self.assertEqual(self.kept(), [])

    def test_a_second_run_traces_nothing_and_writes_the_same(self):
        self.assertRegex(self.trace("x.exr"), r"96×54, 256 rays a pixel, [\d.]+ million rays in ")
        first, kept = (self.folder / "x.exr").read_bytes(), self.kept()
        self.assertEqual(len(kept), 1)
        self.assertIn("from the cache", self.trace("x.exr"))
        self.assertEqual((self.folder / "x.exr").read_bytes(), first)
        self.assertEqual(self.kept(), kept)

    def test_the_cache_tells_apart_all_that_matters(self):
        variants = [(), ("--spp", "64"), ("--seed", "1"), ("--error", "0.01"), ("--sun", "30,30"),
                    ("--sun-angle", "2"), ("--set", "sun.shape=square"), ("--size", "97x54"),
                    ("--eye", "3,2,3", "--target", "0,0,0")]
        for i, more in enumerate(variants):
            with self.subTest(more):
                self.assertNotIn("from the cache", self.trace("x.png", *more, size=() if "--size" in more else SMALL))
                self.assertEqual(len(self.kept()), i + 1)
        # What no ray sees does not matter.
        self.assertIn("from the cache", self.trace("x.png", "--exposure", "10", "--set", "cascades.size=256"))
        self.assertNotIn("from the cache", self.trace("x.png", of=scene("moving"), size=SMALL))
        self.assertNotIn("from the cache", self.trace("x.png", "--time", "0.5", of=scene("moving"), size=SMALL))

    def test_a_damaged_cache_is_not_believed(self):
        self.trace("x.exr")
        good = (self.folder / "x.exr").read_bytes()
        kept = self.kept()[0]
        contents = kept.read_bytes()
        for damage in (b"", contents[:40], contents[:-1], contents + b"x", b"\0" * len(contents),
                       contents[:5000] + b"\xff\xff\xff\xff" + contents[5004:]):
            kept.write_bytes(damage)
            self.assertNotIn("from the cache", self.trace("x.exr"))
            self.assertEqual((self.folder / "x.exr").read_bytes(), good)

    def test_a_cache_that_cannot_be_written_is_no_failure(self):
        (self.folder / "file").write_text("")
        result = self.succeed("truth", FENCE, "-o", self.folder / "x.png", *SMALL, "--spp", "8", "--cache",
                              self.folder / "file")
        self.assertIn("warning: the cache", result.stderr)

    def test_an_error_bound_that_is_too_low_is_told(self):
        arguments = ("truth", scene("steps"), "-o", self.folder / "x.exr", "--size", "32x18", "--sun-angle", "5",
                     "--spp", "65536", "--no-cache", "--error")
        self.assertIn("truth.error 1e-05 is not reached", self.succeed(*arguments, "0.00001").stderr)
        self.assertEqual(self.succeed(*arguments, "0.01").stderr, "")

    def test_an_error_bound_is_met(self):
        view = ("--sun-angle", "4", "--eye", "0,3,6", "--target", "0,0,0", *SMALL)
        self.trace("x.exr", "--spp", "64", "--error", "0.004", *view, size=())
        layers = read_exr(self.folder / "x.exr")
        errors = [e for rows in zip(layers["standard_error.V"], layers["receiver.V"]) for e, r in zip(*rows) if r]
        self.assertGreater(max(errors), 0)
        self.assertLessEqual(sum(e > 0.004 for e in errors), len(errors) / 1000 + 1)

    def test_a_sequence_follows_the_animation(self):
        self.trace("x_#.png", "--frames", "0:2", "--fps", "4", "--spp", "8", of=scene("moving"))
        names = sorted(path.name for path in self.folder.glob("*.png"))
        self.assertEqual(names, ["x_0.png", "x_1.png", "x_2.png"])
        self.assertEqual(len({(self.folder / name).read_bytes() for name in names}), 3)

    def local_scene(self, kind):
        """A quad 2 m over a ground, under a light at 4 m that points down."""
        import base64
        import struct

        def quad(y, half):
            return [(-half, y, -half), (-half, y, half), (half, y, half), (half, y, -half)]

        points = quad(0, 8) + quad(2, 0.5)
        data = struct.pack("<24f", *(c for p in points for c in p)) + struct.pack("<6H", 0, 1, 2, 0, 2, 3)
        views = [{"buffer": 0, "byteOffset": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 48},
                 {"buffer": 0, "byteOffset": 96, "byteLength": 12}]
        accessors = [{"bufferView": i, "componentType": 5126, "count": 4, "type": "VEC3",
                      "min": list(map(min, zip(*points[4 * i : 4 * i + 4]))),
                      "max": list(map(max, zip(*points[4 * i : 4 * i + 4])))} for i in (0, 1)]
        accessors.append({"bufferView": 2, "componentType": 5123, "count": 6, "type": "SCALAR"})
        light = {"type": kind, "name": "lamp", **({"spot": {}} if kind == "spot" else {})}
        down = [-0.70710678, 0, 0, 0.70710678]  # -Z to -Y
        gltf = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1, 2]}],
                "extensionsUsed": ["KHR_lights_punctual"],
                "extensions": {"KHR_lights_punctual": {"lights": [light]}},
                "nodes": [{"mesh": 0}, {"mesh": 1}, {"translation": [0, 4, 0], "rotation": down,
                                                     "extensions": {"KHR_lights_punctual": {"light": 0}}}],
                "meshes": [{"primitives": [{"attributes": {"POSITION": i}, "indices": 2}]} for i in (0, 1)],
                "accessors": accessors, "bufferViews": views,
                "buffers": [{"byteLength": len(data),
                             "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}]}
        path = self.folder / f"{kind}.gltf"
        path.write_text(json.dumps(gltf))
        return path

    def test_lights_of_the_scene(self):
        # The quad's shadow on the ground reaches to 1 m, its penumbra (radius 0.25) from 0.75 to 1.25 m.
        view = ("--eye", "0.0001,1.9,0", "--target", "0,0,0", "--fov", "90", "--size", "64x64", "--spp", "512")
        for kind in ("point", "spot"):
            with self.subTest(kind):
                self.trace("x.exr", *view, "--lights", "lamp", "--lamp-radius", "0.25", of=self.local_scene(kind), size=())
                row = read_exr(self.folder / "x.exr")["shadow.V"][32]
                meters = [abs((2 * (x + 0.5) / 64 - 1) * 1.9) for x in range(64)]
                for value, at in zip(row, meters):
                    if at < 0.7:
                        self.assertEqual(value, 0, at)
                    if at > 1.3:
                        self.assertEqual(value, 1, at)
                middle = [v for v, at in zip(row, meters) if abs(at - 1) < 0.05]
                self.assertTrue(middle)
                for value in middle:
                    self.assertAlmostEqual(value, 0.5, delta=0.15)

    def test_every_light_that_casts_shadows_is_traced(self):
        of, few = scene("gallery"), ("--spp", "8")
        said = self.trace("all.exr", *few, of=of)
        self.assertIn("4 lights, 8 rays a pixel each", said)
        together, header = read_exr(self.folder / "all.exr"), read_exr_header(self.folder / "all.exr")
        names = [header[f"penumbra:light.{i}"] for i in (1, 2, 3, 4)]
        self.assertEqual(set(together), {name.replace(".", f"_{i}.") if i > 1 else name
                                         for name in LAYERS for i in (1, 2, 3, 4)})
        self.trace("all.png", *few, of=of)
        for i, name in enumerate(names):
            with self.subTest(name):
                self.assertIn("from the cache", self.trace("one.exr", *few, "--lights", name, of=of))
                alone = read_exr(self.folder / "one.exr")
                self.assertGreater(sum(v > 0 for row in alone["shadow.V"] for v in row), 50)
                for layer, values in alone.items():
                    self.assertEqual(values, together[layer.replace(".", f"_{i + 1}.") if i else layer], layer)
                self.trace("one.png", *few, "--lights", name, of=of)
                picture = self.folder / (f"all.shadow_{i + 1}.png" if i else "all.png")
                self.assertEqual(read_png(picture), read_png(self.folder / "one.png"))
        self.assertEqual(sorted(path.name for path in self.folder.glob("all*")),
                         ["all.exr", "all.png", "all.shadow_2.png", "all.shadow_3.png", "all.shadow_4.png"])

    def test_lights_are_chosen_as_for_render(self):
        of = scene("gallery")
        for more, names in (((), 4), (("--no-sun",), 3), (("--lights", "pendant,sun"), 2),
                            (("--lights", "none", "--lamp", "0,2.4,0"), 1), (("--lamp", "0,2.4,0:radius=0.1"), 5)):
            with self.subTest(more):
                self.trace("t.exr", "--spp", "8", *more, of=of)
                self.succeed("render", of, "-o", self.folder / "r.exr", *SMALL, *SMALL_MAPS, "--technique", "truth",
                             "--set", "truth.samples=8", "--aov", "shadow", "--cache", self.cache, *more)
                traced, drawn = (read_exr(self.folder / f"{name}.exr") for name in ("t", "r"))
                layers = [name for name in drawn if name.startswith("shadow")]
                self.assertEqual(len(layers), names)
                self.assertEqual(set(layers), {name for name in traced if name.startswith("shadow")})
                for layer in layers:
                    worst = max(abs(a - b) for rows in zip(traced[layer], drawn[layer]) for a, b in zip(*rows))
                    self.assertLess(worst, 0.0006, layer)  # the mask holds half floats

    def test_a_second_light_overwrites_no_file_that_the_scene_names(self):
        of = self.local_scene("point")
        gltf = json.loads(of.read_text())
        gltf["images"] = [{"uri": "x.shadow_2.png"}]
        of.write_text(json.dumps(gltf))
        image = self.folder / "x.shadow_2.png"
        image.write_bytes(b"data")
        self.succeed("truth", of, "-o", self.folder / "y.png", *SMALL, "--spp", "8", "--lamp", "0,3,0")
        error = self.refuse("truth", of, "-o", self.folder / "x.png", *SMALL, "--lamp", "0,3,0", code=2)
        self.assertIn("overwrite the scene's file", error)
        self.assertEqual(image.read_bytes(), b"data")

    def test_wrong_lights(self):
        lamp = self.local_scene("point")
        output = ("-o", self.folder / "x.exr", *SMALL)
        self.assertIn("lamp", self.refuse("truth", lamp, *output, "--lights", "lump"))
        self.assertIn("no lights", self.refuse("truth", self.without_lights(), *output, "--lights", "0"))
        self.refuse("truth", lamp, *output, "--lights", "lamp", "--lamp-radius", "-1", code=2)
        self.assertFalse((self.folder / "x.exr").exists())

    def without_lights(self):
        gltf = json.loads(self.local_scene("point").read_text())
        for key in ("extensionsUsed", "extensions"):
            del gltf[key]
        del gltf["nodes"][2]["extensions"]
        path = self.folder / "dark.gltf"
        path.write_text(json.dumps(gltf))
        return path

    def test_what_it_refuses(self):
        output = ("-o", self.folder / "new" / "x.exr")
        for more in (("--spp", "0"), ("--spp", "many"), ("--spp", "100000"), ("--error", "-1"), ("--error", "nan"),
                     ("--size", "100000x10"), ("--supersample", "2"), ("--seed", "x")):
            with self.subTest(more):
                self.refuse("truth", FENCE, *output, *more, code=2)
        self.refuse("truth", FENCE, "-o", self.folder / "x.jpg", code=2)
        self.refuse("truth", self.folder / "none.glb", *output)
        self.assertEqual(list(self.folder.iterdir()), [])
        self.refuse("truth", FENCE, "-o", "/proc/none/x.exr", *SMALL)
        copy = self.folder / "x.png"
        copy.write_bytes(FENCE.read_bytes())
        self.refuse("truth", copy, "-o", copy, *SMALL, code=2)

    def test_the_command_line_is_checked_before_the_scene(self):
        for more, said in {
            ("--spp", "0"): "truth.samples",
            ("--set", "truth.sample=9"): "did you mean 'truth.samples'",
            ("--set", "sun.angle=wide"): "sun.angle",
            ("--set", "technique=hard"): "'technique=hard' can't be set here",
            ("--cache", "here", "--no-cache"): "--cache and --no-cache exclude each other",
        }.items():
            with self.subTest(more):
                self.assertIn(said, self.refuse("truth", "none.glb", "-o", self.folder / "x.exr", *more, code=2))
        self.refuse("render", "none.glb", "-o", self.folder / "x.exr", "--cache", "here", "--no-cache", code=2)

    def test_the_picture_overwrites_no_file_that_the_scene_names(self):
        gltf = {"asset": {"version": "2.0"}, "images": [{"uri": "x_2.png"}]}
        (self.folder / "s.gltf").write_text(json.dumps(gltf))
        image = self.folder / "x_2.png"
        image.write_bytes(b"data")
        for more in (("-o", image), ("-o", self.folder / "x_#.png", "--frames", "0:4")):
            error = self.refuse("truth", self.folder / "s.gltf", *SMALL, *more, code=2)
            self.assertIn("overwrite the scene's file", error)
        self.assertEqual(image.read_bytes(), b"data")
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["s.gltf", "x_2.png"])

    def test_an_interrupt_leaves_nothing(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            command = [PROGRAM, "truth", scene("foliage"), "-o", self.folder / "x.exr", "--spp", "65536", "--cache",
                       self.cache]
            process = subprocess.Popen(command, stdout=subprocess.DEVNULL)
            wait_until_it_catches(number, process)
            time.sleep(1)  # it most often traces by then; nothing must be left in any case
            process.send_signal(number)
            self.assertEqual(process.wait(timeout=60), 128 + number)
            self.assertEqual([path for path in self.folder.rglob("*") if path.is_file()], [])

    def test_a_limit_of_file_sizes_is_an_error_and_leaves_nothing(self):
        def few_bytes():
            resource.setrlimit(resource.RLIMIT_FSIZE, (512, 512))

        error = self.refuse("truth", FENCE, "-o", self.folder / "x.exr", *SMALL, "--spp", "8", "--cache", self.cache,
                            preexec_fn=few_bytes)
        self.assertIn("x.exr", error)
        self.assertEqual([path for path in self.folder.rglob("*") if path.is_file()], [])

    def test_render_draws_by_it(self):
        self.trace("t.exr", "--spp", "64")
        self.succeed("render", FENCE, "-o", self.folder / "r.exr", *SMALL, *SMALL_MAPS, "--technique", "truth", "--set",
                     "truth.samples=64", "--aov", "shadow", "--cache", self.cache)
        traced, drawn = (read_exr(self.folder / f"{name}.exr")["shadow.V"] for name in ("t", "r"))
        worst = max(abs(a - b) for rows in zip(traced, drawn) for a, b in zip(*rows))
        self.assertLess(worst, 0.0006)  # the mask holds half floats
        self.assertEqual(len(self.kept()), 1)

    def test_no_part_of_a_square_sun_is_below_a_receiver(self):
        """And compare measures the same receivers."""
        counts = []
        for shape in ("disc", "square"):
            # The ground sees the whole disc of 10° about 12°, but not the corners of its square.
            view = (scene("posts"), *SMALL, *SMALL_MAPS, "--sun", "0,12", "--sun-angle", "20", "--set", f"sun.shape={shape}",
                    "--no-cache", "--quiet", "--spp", "8")
            self.succeed("truth", *view, "-o", self.folder / "x.exr")
            receivers = sum(sum(row) for row in read_exr(self.folder / "x.exr")["receiver.V"])
            self.succeed("compare", *view, "-o", self.folder / "report", "--technique", "hard", "--no-cost")
            document = json.loads((self.folder / "report" / "results.json").read_text())
            self.assertAlmostEqual(document["scenes"][0]["receivers"], receivers, delta=receivers // 100)
            counts.append(receivers)
        self.assertGreater(counts[1], 0)  # posts face the sun
        self.assertLess(counts[1], counts[0] / 4)

    def test_receivers_are_a_mask_for_diff(self):
        # Seen from the side, half of what the posts show faces away from the sun or lies along its rays.
        of, view = scene("posts"), ("--eye", "0,4,14", "--target", "0,2,0", "--fov", "50", *SMALL)
        self.trace("t.exr", *view, of=of, size=())
        self.succeed("render", of, "-o", self.folder / "r.exr", "--aov", "shadow", "--technique", "brute_force", *view)
        figures = [json.loads(self.succeed("diff", self.folder / "r.exr", self.folder / "t.exr", "--layer", "shadow",
                                           "--json", "-", *mask).stdout)["figures"]["rmse"]
                   for mask in ((), ("--mask", "receiver"))]
        self.assertLess(figures[1], 0.1)
        self.assertLess(figures[1], figures[0])

    def test_the_usual_cache_is_the_users(self):
        home = self.folder / "home"
        environment = {**os.environ, "MESA_SHADER_CACHE_DIR": shader_cache(), "HOME": str(home)}
        environment.pop("XDG_CACHE_HOME", None)
        self.succeed("truth", FENCE, "-o", self.folder / "x.png", *SMALL, "--spp", "8", env=environment)
        self.assertEqual(len(list((home / ".cache/penumbra/truth").iterdir())), 1)

    def test_a_cache_folder_that_is_relative_is_ignored(self):
        # As the XDG base directory specification says.
        home = self.folder / "home"
        environment = {**os.environ, "MESA_SHADER_CACHE_DIR": shader_cache(), "HOME": str(home), "XDG_CACHE_HOME": "here"}
        self.succeed("truth", FENCE.resolve(), "-o", self.folder / "x.png", *SMALL, "--spp", "8", env=environment,
                     cwd=self.folder)
        self.assertEqual(len(list((home / ".cache/penumbra/truth").iterdir())), 1)
        self.assertFalse((self.folder / "here" / "penumbra").exists())


if __name__ == "__main__":
    main()
