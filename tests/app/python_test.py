"""The Python module, as users import it: pictures, truth, metrics, errors, Ctrl-C, and the code of its page in docs."""

import json
import os
import pathlib
import re
import signal
import subprocess
import time
import unittest

import support

PACKAGE = support.BUILD / "python"
PYTHON = "/usr/bin/python3" if os.path.exists("/usr/bin/python3") else support.sys.executable


@unittest.skipUnless(any(PACKAGE.glob("penumbra/_penumbra*.so")), "skipped: built without the Python module")
class Module(support.TestCase):
    def environment(self):
        return {**os.environ, "PYTHONPATH": str(PACKAGE), "XDG_CACHE_HOME": str(self.folder / "cache"),
                "MESA_SHADER_CACHE_DIR": support.shader_cache()}

    def run_code(self, code, folder=support.ROOT):
        return subprocess.run([PYTHON, "-B", "-c", code], capture_output=True, text=True, timeout=300, cwd=folder,
                              env=self.environment())

    def python(self, code):
        result = self.run_code(code)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        return result.stdout

    def test_pictures_are_those_of_the_program(self):
        """Bit for bit, as `render` and `truth` write them; and again."""
        render, truth = self.folder / "render.exr", self.folder / "truth.exr"
        view = ["--size", "96x54", "--sun-angle", "2", "--backend", "osmesa"]
        self.succeed("render", "scenes/steps.glb", "-o", render, *view, "--technique", "pcss", "--aov", "shadow,normal",
                     "--set", "pcss.filter_taps=7", cwd=support.ROOT)
        self.succeed("truth", "scenes/steps.glb", "-o", truth, *view, "--spp", "8", "--no-cache", cwd=support.ROOT)
        self.python(f"""
import penumbra, numpy
scene = penumbra.open("scenes/steps.glb", size=(96, 54), sun_angle=2, backend="osmesa", no_cache=True)
assert scene.size == (96, 54) and scene.lights == 1
scene.select("pcss")
scene["pcss.filter_taps"] = numpy.int64(7)
assert scene["pcss.filter_taps"] == scene.params()["pcss.filter_taps"] == 7
frame = scene.render(["shadow", "normal", "display"])
assert frame["shadow"].shape == (54, 96) and frame["normal"].shape == (54, 96, 3)
assert frame["display"].dtype == numpy.uint8 and frame["display"].shape == (54, 96, 3)
traced = scene.truth(samples=8)
assert not any(numpy.array_equal(frame["shadow"], picture) for picture in traced.values())
assert numpy.array_equal(scene.render("shadow"), frame["shadow"])
for file, layer, picture in (("{render}", "shadow", frame["shadow"]), ("{render}", "normal", frame["normal"]),
                             ("{truth}", "shadow", traced["shadow"]), ("{truth}", "receiver", traced["receiver"])):
    assert numpy.array_equal(penumbra.read(file, layer), picture), layer
""")

    def test_frames_are_at_their_times(self):
        frame = self.folder / "frame.png"
        self.succeed("render", "scenes/moving.glb", "-o", frame, "--size", "96x54", "--technique", "pcss", "--samples", "1",
                     "--frame", "6", "--fps", "12", "--backend", "osmesa", cwd=support.ROOT)
        self.python(f"""
import penumbra, numpy
scene = penumbra.open("scenes/moving.glb", size=(96, 54), technique="pcss", samples=1, fps=12, backend="osmesa",
                      no_cache=True)
first, sixth = scene.render(frame=0), scene.render(frame=6)
assert not numpy.array_equal(first, sixth)
assert numpy.array_equal(sixth, numpy.rint(255 * penumbra.read("{frame}")).astype(numpy.uint8))
assert not numpy.array_equal(scene.truth(samples=8, frame=6)["shadow"], scene.truth(samples=8)["shadow"])
""")

    def test_a_frame_that_is_drawn_again_begins_a_new_history(self):
        self.python("""
import penumbra, numpy
scene = penumbra.open("scenes/moving.glb", size=(96, 54), technique="thesis", samples=1, fps=12, backend="osmesa",
                      no_cache=True)
for frame in (0, 5):
    assert numpy.array_equal(scene.render("shadow", frame=frame), scene.render("shadow", frame=frame)), frame
alone = scene.render("shadow", frame=1)
scene.render(frame=0)
assert not numpy.array_equal(scene.render("shadow", frame=1), alone)
""")

    def test_samples_have_shadows_of_their_own_where_asked(self):
        written = self.folder / "render.png"
        self.succeed("render", "scenes/steps.glb", "-o", written, "--size", "96x54", "--samples", "4", "--sample-shadows",
                     "--backend", "osmesa", "--technique", "pcss", cwd=support.ROOT)
        self.python(f"""
import penumbra, numpy
def drawn(**options):
    scene = penumbra.open("scenes/steps.glb", size=(96, 54), samples=4, backend="osmesa", **options)
    scene.select("pcss")
    return scene.render("display")
own = drawn(sample_shadows=True)
assert numpy.array_equal(own, numpy.rint(penumbra.read("{written}") * 255)), "as the program's"
assert not numpy.array_equal(own, drawn())
""")

    def test_each_scene_warns_of_a_sun_that_its_ground_hides(self):
        result = self.run_code("""
import penumbra
for name in ("steps", "posts"):
    scene = penumbra.open(f"scenes/{name}.glb", size=(96, 54), sun=(40, -10), no_cache=True)
    for _ in range(2):
        assert scene.render("shadow").max() == 0 and scene.truth(samples=8)["shadow"].max() == 0
""")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stderr.count("below the horizon"), 2, result.stderr)

    def test_difference_is_that_of_the_program(self):
        for name, sun in (("a", "1"), ("b", "3")):
            self.succeed("render", "scenes/steps.glb", "-o", self.folder / f"{name}.exr", "--size", "96x54", "--aov",
                         "shadow", "--sun-angle", sun, cwd=support.ROOT)
        told = json.loads(self.succeed("diff", self.folder / "a.exr", self.folder / "b.exr", "--layer", "shadow", "--json",
                                       "-").stdout)
        figures = json.loads(self.python(f"""
import penumbra, json
a, b = (penumbra.read(f"{self.folder}/{{name}}.exr", "shadow") for name in "ab")
print(json.dumps(penumbra.difference(a, b)))
"""))
        self.assertEqual(set(figures), {*told["figures"], "not_finite"})
        for name, value in told["figures"].items():
            self.assertAlmostEqual(value, figures[name], places=6, msg=name)

    def test_receivers_are_those_of_a_mask_of_the_program(self):
        self.python("""
import penumbra, numpy
nan, inf = numpy.nan, numpy.inf
test, reference = numpy.array([[nan, 0, 0, 0, inf]]), numpy.array([[0, 0.5, 0.75, 1, nan]])
figures = penumbra.difference(test, reference, [[1, -1, 0, nan, inf]])
assert figures["max"] == 1 and figures["not_finite"] == 1 and abs(figures["rmse"] - (1.25 / 2) ** 0.5) < 1e-6, figures
for none in ([[0] * 5], [[nan, 0, inf, -inf, 0]]):
    try:
        penumbra.difference(test, reference, none)
    except penumbra.Error as error:
        assert str(error) == "the array of receivers leaves no pixel", error
    else:
        raise AssertionError(none)
""")

    def test_colours_have_the_metrics_of_pictures_too(self):
        for name, sun in (("a", "1"), ("b", "3")):
            self.succeed("render", "scenes/steps.glb", "-o", self.folder / f"{name}.png", "--size", "96x54", "--sun-angle", sun,
                         cwd=support.ROOT)
        told = json.loads(self.succeed("diff", self.folder / "a.png", self.folder / "b.png", "--json", "-").stdout)
        for given in ("penumbra.difference(*[numpy.round(255 * p).astype(numpy.uint8) for p in (a, b)])",
                      "penumbra.difference(a, b, display=True)"):
            figures = json.loads(self.python(f"""
import penumbra, json, numpy
a, b = (penumbra.read(f"{self.folder}/{{name}}.png") for name in "ab")
assert "flip" not in penumbra.difference(a, b), "floats are linear unless they are said to be of a display"
print(json.dumps({given}))
"""))
            for name in ("ssim", "flip"):
                self.assertAlmostEqual(told["figures"][name], figures[name], places=5, msg=name)

    def test_errors_are_exceptions_of_one_line(self):
        self.python("""
import penumbra, numpy
scene = penumbra.open("scenes/steps.glb", size="32x18")
def refused(call, kind, text):
    try:
        call()
    except kind as error:
        assert text in str(error) and len(str(error)) < 200 + 100 * ("known:" in str(error)), str(error)
    else:
        raise AssertionError(text)
shadow = scene.render("shadow")
refused(lambda: penumbra.open("none.glb"), penumbra.Error, "none.glb: file not found")
refused(lambda: penumbra.open("scenes/steps.glb", size=(0, 1)), penumbra.UsageError, "--size can't be '0x1'")
refused(lambda: penumbra.open("scenes/steps.glb", siez=(1, 1)), penumbra.UsageError, "'--size'")
refused(lambda: penumbra.open("scenes/steps.glb", eye=(1, 2, 3)), penumbra.UsageError, "--eye and --target")
refused(lambda: penumbra.open("scenes/steps.glb", preset=True), penumbra.UsageError, "--preset lacks its value")
refused(lambda: penumbra.open("scenes/steps.glb", preset=True, size=(1, 1)), penumbra.UsageError,
        "--preset lacks its value")
refused(lambda: scene.select("pccs"), penumbra.Error, "did you mean 'pcss'")
for frame in (-5, 10**6):
    refused(lambda: scene.render(frame=frame), penumbra.UsageError, f"frame can't be {frame}, only 0 to 999999")
    refused(lambda: scene.truth(frame=frame), penumbra.UsageError, f"frame can't be {frame}, only 0 to 999999")
refused(lambda: scene.__setitem__("sun.angle", 99), penumbra.UsageError, "0 to 20")
refused(lambda: scene["sun.angl"], penumbra.UsageError, "'sun.angle'")
refused(lambda: scene.select("pcs"), penumbra.UsageError, "'pcss'")
scene["pcss.early_exit"] = numpy.bool_(False)
assert scene["pcss.early_exit"] is False
for shape in ((4, 4, 0), (0, 0)):
    refused(lambda: penumbra.difference(numpy.zeros(shape), numpy.zeros(shape)), penumbra.Error, "no values")
refused(lambda: penumbra.difference("a", "b"), penumbra.Error, "no array of numbers")
assert penumbra.difference([[0.0, 1.0]], [[0.0, 0.5]])["max"] == 0.5
shown = scene.render()
assert penumbra.difference(shown, shown / 255)["rmse"] < 1e-6
refused(lambda: scene["sun.angel"], penumbra.Error, "sun.angle")
refused(lambda: scene["zzzzzzzz"], penumbra.UsageError, "penumbra.params()")
refused(lambda: scene.render("shadwo"), penumbra.UsageError, "'shadow'")
refused(lambda: scene.__setitem__("zzzzzzzz", 1), penumbra.UsageError, "penumbra.params()")
refused(lambda: scene.render("shadow", light=1), penumbra.UsageError, "light 1 of 1")
refused(lambda: scene.truth(light=-1), penumbra.UsageError, "light -1 of 1")
refused(lambda: scene.truth(samples=1), penumbra.UsageError, "8 to 65536")
refused(lambda: penumbra.difference(shadow, shadow[:, 1:]), penumbra.Error, "differ in size")
refused(lambda: penumbra.difference(shadow[0], shadow), penumbra.Error, "1 dimensions")
refused(lambda: penumbra.difference(shadow, shadow, shadow[1:]), penumbra.Error, "receivers")
assert numpy.array_equal(scene.render("shadow"), shadow)
""")

    def test_scenes_of_other_threads_are_refused_and_several_can_be_open(self):
        self.python("""
import penumbra, numpy, threading
first = penumbra.open("scenes/steps.glb", size="32x18")
shadow = first.render("shadow")
second = penumbra.open("scenes/posts.glb", size="16x9")
assert second.render("shadow").shape == (9, 16)
assert numpy.array_equal(first.render("shadow"), shadow)
told = []
def draw():
    for call in (lambda: first.render("shadow"), lambda: first["sun.angle"], lambda: first.select("pcss"), first.params,
                 lambda: first.__setitem__("sun.angle", 2)):
        try:
            call()
        except penumbra.Error as error:
            told.append(str(error))
thread = threading.Thread(target=draw)
thread.start()
thread.join()
assert told == 5 * ["a scene can be used only on the thread that opened it"], told
""")

    def test_ctrl_c_interrupts_tracing(self):
        code = """
import penumbra, sys
scene = penumbra.open("scenes/steps.glb", size="320x180", no_cache=True)
shadow = scene.render("shadow")
try:
    print("tracing", flush=True)
    scene.truth(samples=65536)
except KeyboardInterrupt:
    print("interrupted", (scene.render("shadow") == shadow).all())
"""
        process = subprocess.Popen([PYTHON, "-B", "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                   cwd=support.ROOT, env=self.environment())
        self.addCleanup(process.kill)
        self.assertEqual(process.stdout.readline(), "tracing\n")
        time.sleep(0.5)  # it most often traces by then; the answer is the same in any case
        process.send_signal(signal.SIGINT)
        output, errors = process.communicate(timeout=120)
        self.assertEqual((output, process.returncode), ("interrupted True\n", 0), errors)

    def test_code_of_the_page_runs(self):
        blocks = re.findall(r"(?ms)^```python\n(.*?)^```", (support.ROOT / "docs" / "python.md").read_text())
        self.assertGreater(len(blocks), 1)
        self.assertRegex(self.python("".join(blocks)), r"^rms error 0\.0\d+, \d\d\.\d dB in penumbrae\n$")

    def test_example_shows_that_more_taps_err_less(self):
        """As a table, and as a plot with its axes and a curve that falls."""
        table = self.folder / "out" / "taps.csv"
        result = subprocess.run([PYTHON, "-B", support.ROOT / "examples" / "python" / "error_over_taps.py",
                                 support.ROOT / "scenes" / "steps.glb", "-o", table, "--taps", "2", "8", "32", "--size",
                                 "160x90"], capture_output=True, text=True, timeout=300, env=self.environment())
        self.assertEqual(result.returncode, 0, result.stderr)
        lines = table.read_text().splitlines()
        self.assertEqual(lines[0], "taps,rmse,psnr_penumbra")
        errors = [float(line.split(",")[1]) for line in lines[1:]]
        self.assertEqual(errors, sorted(errors, reverse=True))
        self.assertLess(errors[-1], 0.6 * errors[0])
        plot = table.with_suffix(".png")
        self.assertTrue(plot.exists(), result.stdout)
        rows = support.read_png(plot)
        self.assertEqual((len(rows[0]), len(rows)), (640, 480))
        drawn = [(x, y, pixel[:3]) for y, row in enumerate(rows) for x, pixel in enumerate(row)]
        self.assertGreater(sum(color == (0, 0, 0) for _, _, color in drawn), 1000)  # the frame, its ticks and the words
        curve = [(x, y) for x, y, color in drawn if color == (31, 119, 180)]  # Matplotlib's first colour
        self.assertGreater(len(curve), 300)
        left, right = min(curve), max(curve)
        self.assertGreater(right[0] - left[0], 400)
        self.assertGreater(right[1] - left[1], 100)  # rows count from the top


if __name__ == "__main__":
    support.main()
