"""Sequences: numbered files, each the picture of its own time."""

from pictures import SMALL, SMALL_MAPS, read_png, scene
from support import TestCase, main

MOVING = scene("moving")


class Sequence(TestCase):
    def draw(self, output, *arguments):
        return self.succeed("render", MOVING, "-o", self.folder / output, *SMALL, *SMALL_MAPS, *arguments)

    def files(self):
        return sorted(path.name for path in self.folder.iterdir())

    def test_files_are_numbered(self):
        for output, names in (
            ("x.png", ["x_0009.png", "x_0010.png"]),
            ("x##y.png", ["x09y.png", "x10y.png"]),
            ("x-%03d.png", ["x-009.png", "x-010.png"]),
        ):
            with self.subTest(output):
                self.draw(output, "--frames", "9:10", "--quiet")
                self.assertEqual(self.files(), names)
                for path in self.folder.iterdir():
                    path.unlink()
        self.draw("x.png", "--frames", "3:3", "--aov", "shadow")
        self.assertEqual(self.files(), ["x_0003.png", "x_0003.shadow.png"])

    def test_a_bad_pattern_is_wrong_usage(self):
        for output in ("x%s.png", "x%d%d.png", "x##_##.png", "x##_%d.png", "x%00d.png"):
            with self.subTest(output):
                self.refuse("render", MOVING, "-o", self.folder / output, "--frames", "0:1", code=2)
        self.assertEqual(self.files(), [])

    def test_a_single_picture_has_no_number(self):
        for output in ("x_##.png", "x%04d.png"):
            with self.subTest(output):
                error = self.refuse("render", MOVING, "-o", self.folder / output, code=2)
                self.assertIn("--frames", error)
        self.draw("100%.png")
        self.assertEqual(self.files(), ["100%.png"])

    def test_one_frame_has_the_name_that_was_asked_for(self):
        rate = ("--fps", "4", "--time", "0.25")
        self.draw("x.png", "--frames", "3:3", *rate)
        self.draw("y.png", "--frame", "3", "--aov", "shadow", *rate)
        self.assertEqual(self.files(), ["x_0003.png", "y.png", "y.shadow.png"])
        self.assertEqual((self.folder / "y.png").read_bytes(), (self.folder / "x_0003.png").read_bytes())
        self.draw("z.png", "--frame", "2", *rate)
        self.assertNotEqual((self.folder / "z.png").read_bytes(), (self.folder / "y.png").read_bytes())
        for output, more in (("w.png", ["--frames", "0:1"]), ("w_##.png", [])):
            self.assertIn("--frames", self.refuse("render", MOVING, "-o", self.folder / output, "--frame", "3", *more,
                                                  code=2))

    def test_a_frame_is_the_picture_of_its_time(self):
        fit = ("--set", "cascades.fit=stable")
        self.draw("x.png", "--frames", "2:4", "--fps", "4", "--time", "0.25", *fit)
        self.draw("still.png", "--time", "1.0", *fit)
        self.assertEqual((self.folder / "still.png").read_bytes(), (self.folder / "x_0003.png").read_bytes())
        self.assertNotEqual((self.folder / "x_0002.png").read_bytes(), (self.folder / "x_0003.png").read_bytes())

    def test_only_maps_of_single_pictures_are_fitted_to_them(self):
        def drawn(*arguments):
            self.draw("x.png", *arguments)
            path = self.folder / ("x_0000.png" if "--frames" in arguments else "x.png")
            return path.read_bytes()

        stable, fitted = (("--set", f"cascades.fit={fit}") for fit in ("stable", "penumbrae"))
        single = drawn()
        self.assertEqual(single, drawn(*fitted))
        self.assertNotEqual(single, drawn(*stable))
        self.assertEqual(drawn("--technique", "slices_denoised"), drawn(*stable))
        self.assertEqual(drawn("--frames", "0:0"), drawn(*stable))

    def test_a_frame_does_not_depend_on_where_the_sequence_starts(self):
        self.draw("a.png", "--frames", "1:3", "--aov", "shadow,motion")
        self.draw("b.png", "--frames", "3:3", "--aov", "shadow,motion")
        self.draw("c.png", "--frames", "3:3", "--aov", "shadow,motion", "--warmup", "2")
        for suffix in ("", ".shadow", ".motion"):
            pictures = [(self.folder / f"{name}_0003{suffix}.png").read_bytes() for name in "abc"]
            self.assertEqual(len(set(pictures)), 1, suffix)

    def test_frames_before_a_part_come_to_it_or_stand_still_at_it(self):
        remembers = ("--technique", "thesis", "--warmup", "6")
        frame = ("--frames", "3:3", "--fps", "4")
        self.draw("moves.png", *frame, *remembers)
        self.draw("still.png", *frame, *remembers, "--warmup-still")
        self.draw("moment.png", "--time", "0.75", *remembers)
        moves, still = ((self.folder / f"{name}_0003.png").read_bytes() for name in ("moves", "still"))
        self.assertNotEqual(moves, still)
        self.assertEqual(still, (self.folder / "moment.png").read_bytes())

    def test_frames_move_and_stills_do_not(self):
        self.draw("x.png", "--frames", "5:5", "--aov", "motion")
        self.draw("still.png", "--time", "0.3", "--aov", "motion")
        grey = bytes((128, 128, 128))

        def moved(name):
            rows = read_png(self.folder / name)[3]
            return sum(row[i:i + 3] != grey for row in rows for i in range(0, len(row), 3))

        self.assertGreater(moved("x_0005.motion.png"), 20)
        self.assertEqual(moved("still.motion.png"), 0)

    def test_the_summary_names_first_and_last(self):
        result = self.draw("x.png", "--frames", "0:2")
        self.assertRegex(result.stdout, r"^wrote \S+x_0000\.png to \S+x_0002\.png \(96×54, slices_denoised, .* s\)\n$")
        self.assertEqual(result.stderr, "", "progress is for terminals")


if __name__ == "__main__":
    main()
