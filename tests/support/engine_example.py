"""What the tests of the examples for engines share: each is built against the installed package, and its shadows are
where the engine's own rays find them."""

import pathlib
import re
import shutil
import subprocess

import desktop
import support

MOST_RMS = 0.015  # of a hard shadow's mask minus rays: a pixel or two in ten thousand on the other side of an outline


def command(*arguments, **options):
    """Runs a command that has to succeed; what it printed is in the failure otherwise."""
    result = subprocess.run([*map(str, arguments)], capture_output=True, text=True, timeout=600, **options)
    if result.returncode != 0:
        raise AssertionError(f"{' '.join(map(str, arguments))}\n{result.stdout}{result.stderr}")
    return result.stdout


def read(path):
    rows = support.read_png(path)
    return desktop.Picture(len(rows[0]), len(rows), [b"".join(bytes(pixel[:3]) for pixel in row) for row in rows])


class EngineExample:
    """The tests of one example; a test case derives from it and from support.TestCase."""

    name = None  # of its folder and of its program
    title = None  # a word of its window's title
    floor = None  # rows of a picture of 160 x 90 that show ground, of which only shadows change

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        folder = support.temporary_folder()
        cls.addClassCleanup(folder.cleanup)
        prefix, build = pathlib.Path(folder.name, "prefix"), pathlib.Path(folder.name, "build")
        command("cmake", "--install", support.BUILD, "--prefix", prefix)
        command("cmake", "-S", support.ROOT / "examples" / cls.name, "-B", build, "-G", "Ninja",
                f"-DCMAKE_PREFIX_PATH={prefix}", "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_COMPILE_WARNING_AS_ERROR=ON",
                *(["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []))
        command("cmake", "--build", build)
        cls.program = build / cls.name
        cls.screen = cls.enterClassContext(desktop.Desktop(640, 480))

    def draw(self, name, *arguments, size="160x90"):
        command(self.program, "--picture", self.folder / name, "--size", size, *arguments,
                env=self.screen.environment())
        return read(self.folder / name)

    def refuse(self, *arguments, environment=None):
        """One line of error, which is returned."""
        result = subprocess.run([self.program, *arguments], capture_output=True, text=True, timeout=300,
                                env=environment or self.screen.environment())
        self.assertEqual(result.returncode, 1, result.stdout)
        self.assertRegex(result.stderr, r"^error: [^\n]+\n$")
        return result.stderr

    def test_hard_shadows_are_where_rays_find_them(self):
        """Also those of what has moved, once the maps and the state of several frames lie behind."""
        for frames in (1, 8):
            with self.subTest(frames=frames):
                found = command(self.program, "--check", "--size", "320x180", "--frames", str(frames),
                                env=self.screen.environment())
                rms, points = re.fullmatch(r"rms ([\d.]+) at (\d+) points\n", found).groups()
                self.assertLess(float(rms), MOST_RMS)
                self.assertGreater(int(points), 20000)

    def test_shadow_maps_show_the_same_shadows(self):
        """Of the casters, which are drawn into maps in other passes than those of the technique that is checked."""
        for frames in ("1", "30"):
            with self.subTest(frames=frames):
                exact, mapped, lit = (self.draw(f"{technique}.png", "--frames", frames, "--technique", technique)
                                      for technique in ("shadow_volume", "hard", "none"))
                self.assertGreater(exact.differing(lit, by=20), 0.04)
                self.assertLess(mapped.differing(exact, by=20), 0.01)

    def test_shadows_are_in_the_picture_and_move(self):
        first, lit = self.draw("first.png"), self.draw("lit.png", "--technique", "none")
        self.assertGreater(first.differing(lit, by=20), 0.04)
        for one, other in zip(first.rows, lit.rows):
            self.assertTrue(all(a <= b + 1 for a, b in zip(one, other)), "a shadow that is brighter than the light")
        still = self.draw("still.png", "--frames", "1")
        self.assertEqual(first.rows, still.rows)
        later = self.draw("later.png", "--frames", "30")
        self.assertNotEqual(first.rows[self.floor], later.rows[self.floor])
        self.assertGreater(first.differing(later, by=20), 0.01)

    def test_a_window_that_was_resized_shows_what_one_of_that_size_shows(self):
        expected = self.draw("expected.png", "--frames", "3", size="400x250")
        process = desktop.start([self.program, "--frames", "3", "--size", "240x200"], env=self.screen.environment(),
                                stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.stderr.close)
        self.addCleanup(desktop.end, process)
        window = self.screen.xdotool("search", "--sync", "--onlyvisible", "--name", self.title).split()[-1]
        self.screen.xdotool("windowsize", "--sync", window, 400, 250)
        self.screen.xdotool("mousemove", "--window", window, 0, 0)
        place = re.match(r"x:(\d+) y:(\d+)", self.screen.xdotool("getmouselocation"))
        x, y = int(place[1]), int(place[2])
        self.screen.move(*self.screen.corner)  # the pointer is in screenshots
        share = 1.0

        def alike():
            nonlocal share
            self.assertIsNone(process.poll(), "the window is gone")
            share = self.screen.screenshot().crop(x, y, x + 400, y + 250).differing(expected, by=2)
            return share < 0.002

        desktop.wait_for(alike, lambda: f"the picture of the new size; {share:.1%} of the pixels differ", pause=0.5)

    def test_errors_are_one_line(self):
        self.assertIn("nonsense", self.refuse("--technique", "nonsense", "--picture", self.folder / "x.png"))
        self.assertIn("--size 3x", self.refuse("--size", "3x"))
        thesis = self.refuse("--technique", "thesis", "--picture", self.folder / "x.png", "--size", "16x16",
                             "--frames", "3")
        self.assertIn("kind 2", thesis)
        self.assertIn("missing/x.png", self.refuse("--picture", "/missing/x.png", "--size", "16x16"))
        without = {**self.screen.environment(), "DISPLAY": ":65000"}
        self.assertIn("display", self.refuse("--check", environment=without))
