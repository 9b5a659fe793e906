"""Parameters: every one is listed, takes its values from --set and from presets, and refuses what it can't be."""

import json
import os
import subprocess

from pictures import SMALL, SMALL_MAPS, scene
from support import TestCase, main, run

POSTS = scene("posts")


def other_value(row):
    """A legal value that is not the default, near it so that pictures stay cheap."""
    default = row["default"]
    if row["type"] == "bool":
        return not default
    if row["type"] == "word":
        return next(choice for choice in row["choices"] if choice != default)
    if row["type"] == "int":
        return default - 1 if default > row["min"] else default + 1
    return min(row["max"], default + 0.25) if default < row["max"] else row["min"]


def text_of(value):
    return str(value).lower() if isinstance(value, bool) else str(value)


def refused_texts(row):
    """A value of a wrong type and one past each end; tests of the parser hold the rest."""
    if row["type"] == "bool":
        return ["maybe"]
    if row["type"] == "word":
        return ["no_such_word"]
    beyond = [row["max"] * 2 + 1, row["min"] - 1]
    return ["1.5", *(str(int(value)) for value in beyond)] if row["type"] == "int" else ["nan", *map(str, beyond)]


class Params(TestCase):
    @classmethod
    def setUpClass(cls):
        cls.rows = json.loads(run("list", "params", "--json").stdout)["rows"]

    def stats_after(self, *arguments, **options):
        stats = self.folder / "stats.json"
        self.succeed("render", POSTS, "-o", self.folder / "x.png", *SMALL, "--quiet", "--stats", stats, *arguments,
                     **options)
        return json.loads(stats.read_text())["params"]

    def preset(self, text):
        path = self.folder / "p.toml"
        path.write_text(text)
        return path

    def test_rows_are_complete(self):
        self.assertGreater(len(self.rows), 20)
        text = self.succeed("list", "params").stdout
        for row in self.rows:
            self.assertRegex(row["name"], r"^[a-z0-9_.]+$")
            self.assertTrue(row["help"].endswith("."), row)
            self.assertIn(row["name"], text)

    def test_each_can_be_set_on_the_command_line_and_by_preset(self):
        wanted = {row["name"]: other_value(row) for row in self.rows}
        assignments = [part for name, value in wanted.items() for part in ("--set", f"{name}={text_of(value)}")]
        saved = self.folder / "saved.toml"
        first = self.stats_after(*assignments, "--save-preset", saved)
        picture = (self.folder / "x.png").read_bytes()
        self.assertEqual(set(first), set(wanted))
        for row in self.rows:
            with self.subTest(row["name"]):
                self.assertEqual(first[row["name"]], wanted[row["name"]])
                self.assertNotEqual(first[row["name"]], row["default"])
        self.assertEqual(self.stats_after("--preset", saved), first)
        self.assertEqual((self.folder / "x.png").read_bytes(), picture)

    def test_each_refuses_wrong_types_and_ranges(self):
        for row in self.rows:
            for text in refused_texts(row):
                with self.subTest(f"{row['name']}={text}"):
                    error = self.refuse("render", POSTS, "-o", self.folder / "x.png", "--set",
                                        f"{row['name']}={text}", code=2)
                    self.assertIn(f"'{row['name']}'", error)
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_presets_fail_with_file_and_line(self):
        for text, words in (
            ('technique = "pcss"\n[pcss]\nfilter_tabs = 3\n', ["p.toml:3:", "'pcss.filter_taps'"]),
            ('technique = "pccs"\n', ["p.toml:1:", "'pcss'"]),
            ("\nsun.angle = 99\n", ["p.toml:2:", "sun.angle"]),
            ("sun.angle = true\n", ["p.toml:1:", "float", "bool"]),
            ("sun.angle = \n", ["p.toml:1:"]),
            ("sun.angle = 1\nsun.angle = 2\n", ["p.toml:2:"]),
            ("pcss.filter_taps = 9223372036854775807\n", ["p.toml:1:", "'9223372036854775807'"]),
        ):
            with self.subTest(text):
                error = self.refuse("render", POSTS, "-o", self.folder / "x.png", "--preset", self.preset(text))
                for word in words:
                    self.assertIn(word, error)
        for path in (self.folder / "none.toml", self.folder):
            self.assertIn("preset", self.refuse("render", POSTS, "-o", self.folder / "x.png", "--preset", path))

    def test_presets_that_can_not_be_read_are_told(self):
        pipe = self.folder / "pipe.toml"
        os.mkfifo(pipe)
        for path, cause in ((self.preset(""), "it is empty"), ("/proc/self/mem", "Input/output error"),
                            (pipe, "no program writes to this pipe")):
            error = self.refuse("render", POSTS, "-o", self.folder / "x.png", "--preset", path, timeout=60)
            self.assertTrue(error.endswith(f"cannot read preset '{path}': {cause}"), error)

    def test_presets_come_from_pipes_whose_writer_takes_its_time(self):
        command = ("sh", "-c", "sleep 0.3; echo 'technique = \"hard\"'; sleep 0.3; echo 'sun.angle = 3'")
        with subprocess.Popen(command, stdout=subprocess.PIPE) as writer:
            number = writer.stdout.fileno()
            values = self.stats_after("--preset", f"/dev/fd/{number}", pass_fds=(number,))
        self.assertEqual((values["technique"], values["sun.angle"]), ("hard", 3))
        with subprocess.Popen(command, stdout=subprocess.PIPE) as writer:
            values = self.stats_after("--preset", "/dev/stdin", stdin=writer.stdout)
        self.assertEqual((values["technique"], values["sun.angle"]), ("hard", 3))

    def test_a_former_name_is_refused_with_the_present_one(self):
        told = "parameter 'pcss.renewal_taps' is now called 'pcss.disocclusion_taps'"
        preset = self.preset("[pcss]\nrenewal_taps = 9\n")
        for arguments in (["--set", "pcss.renewal_taps=9"], ["--preset", preset]):
            with self.subTest(arguments[0]):
                error = self.refuse("render", POSTS, "-o", self.folder / "x.png", *arguments,
                                    code=2 if arguments[0] == "--set" else 1)
                self.assertIn(told, error)
                self.assertEqual(len(error.strip().splitlines()), 1)
        self.assertIn(told, self.refuse("help", "pcss.renewal_taps", code=2))

    def test_later_words_win(self):
        path = self.preset('technique = "hard"\n[sun]\nangle = 1.0\n[pcss]\nfilter_taps = 9\n')
        values = self.stats_after("--set", "sun.angle=3", "--preset", path, "--sun-angle", "2", "--technique",
                                  "pcss_compute", "--set", "pcss.filter_taps=5", "--set", "pcss.filter_taps=6")
        self.assertEqual((values["technique"], values["driver"]), ("pcss", "compute"))
        self.assertEqual((values["sun.angle"], values["pcss.filter_taps"]), (3, 6))
        values = self.stats_after("--preset", path)
        self.assertEqual((values["technique"], values["sun.angle"], values["pcss.filter_taps"]), ("hard", 1, 9))

    def warnings(self, *arguments):
        result = self.succeed("render", POSTS, "-o", self.folder / "x.png", *SMALL, *SMALL_MAPS, "--quiet", *arguments)
        return [line for line in result.stderr.splitlines() if line.startswith("warning: ")]

    def test_what_has_no_effect_is_told_once(self):
        for arguments, told in (
            (["--technique", "slices", "--set", "pcss.filter_taps=9", "--set", "pcss.filter_taps=8"],
             "pcss.filter_taps has no effect here: the technique slices does not read it"),
            (["--set", "history.alpha=0.2"], "history.alpha has no effect here: history.reuse is false"),
            (["--technique", "hard", "--sun-angle", "3"], "sun.angle has no effect here: the shadows of the technique hard"),
            (["--set", "exposure.ev=9"], "exposure.ev has no effect here: exposure.auto is true"),
            (["--fps", "30"], "--fps has no effect here: a single picture is drawn"),
            (["--sample-shadows", "--samples", "1"], "--sample-shadows has no effect here: each pixel has one sample"),
            (["--aov", "shadow", "--aov-samples", "all", "--samples", "1"], "--aov-samples has no effect here: each pixel has"),
            (["--aov", "depth", "--aov-samples", "all"], "--aov-samples has no effect here: none of these AOVs has a mean"),
        ):
            with self.subTest(arguments):
                warned = self.warnings(*arguments)
                self.assertEqual(len(warned), 1, warned)
                self.assertIn(told, warned[0])
        for arguments in (["--technique", "pcss", "--sun-angle", "3", "--set", "pcss.filter_taps=9"],
                          ["--technique", "thesis", "--set", "history.alpha=0.2"],
                          ["--exposure", "9", "--set", "exposure.ev=10"], ["--set", "slices.samples=4"],
                          ["--frame", "0", "--fps", "30"],
                          ["--sample-shadows", "--aov", "shadow,depth", "--aov-samples", "all"]):
            with self.subTest(arguments):
                self.assertEqual(self.warnings(*arguments), [])

    def test_settings_for_lights_that_the_scene_lacks_are_told(self):
        lamp = ("--no-sun", "--lamp", "1,2,3")
        for arguments, told in (
            ((*lamp, "--sun-angle", "3"), "sun.angle has no effect here: no sun shines"),
            ((*lamp, "--set", "cascades.distance=50"), "cascades.distance has no effect here: no sun shines"),
            (("--set", "lamps.near=1"), "lamps.near has no effect here: no spot or point light shines"),
            (("--lamp-radius", "1"), "--lamp-radius has no effect here: no spot or point light shines"),
        ):
            with self.subTest(arguments):
                result = self.succeed("render", POSTS, "-o", self.folder / "x.png", *SMALL, "--quiet", *arguments)
                self.assertEqual([line for line in result.stderr.splitlines() if line.startswith("warning: ")],
                                 [f"warning: {told}"])
        result = self.succeed("render", POSTS, "-o", self.folder / "x.png", *SMALL, "--quiet", "--lamp", "1,2,3",
                              "--sun-angle", "3", "--set", "lamps.near=0.1", "--set", "cascades.distance=50")
        self.assertNotIn("warning", result.stderr)

    def test_the_later_of_a_preset_and_a_technique_counts(self):
        path = self.preset('technique = "thesis_8x8"\nsun.angle = 1.5\n')
        for arguments, technique, taps, visibility in (
            (["--preset", path, "--technique", "hard"], "hard", 16, "none"),
            (["--technique", "hard", "--preset", path], "pcss", 8, "bilateral_separable"),
            (["--technique", "slices_denoised", "--preset", path], "pcss", 8, "bilateral_separable"),
        ):
            with self.subTest(arguments):
                values = self.stats_after(*arguments)
                self.assertEqual((values["technique"], values["pcss.filter_taps"], values["filter.visibility"],
                                  values["sun.angle"]), (technique, taps, visibility, 1.5))
                self.assertEqual(values["slices.narrow"], 0, "nothing of the technique that does not count")
                told = [line for line in self.warnings(*arguments) if "is drawn" in line]
                self.assertEqual(len(told), 1, told)
        plain = self.preset("sun.angle = 1.5\n")
        for arguments in (["--preset", plain, "--technique", "pcf"], ["--technique", "pcf", "--preset", plain],
                          ["--preset", path, "--technique", "thesis_8x8"]):
            self.assertEqual(self.warnings(*arguments), [])

    def test_of_a_preset_that_does_not_count_nothing_stays(self):
        alone = self.stats_after("--technique", "pcss")
        for preset in ("thesis", "slices_denoised"):
            self.assertEqual(self.stats_after("--preset", preset, "--technique", "pcss"), alone, preset)

    def test_a_preset_without_a_technique_changes_what_is_usually_drawn(self):
        plain = self.preset("sun.angle = 1.5\n")
        self.assertEqual(self.stats_after("--preset", plain), self.stats_after("--sun-angle", "1.5"))
        own = self.preset('slices.azimuths = 3\n')
        self.assertEqual(self.stats_after("--preset", own)["slices.azimuths"], 3)

    def test_presets_have_names(self):
        by_name = self.stats_after("--preset", "thesis_8x8", "--set", "filter.taps=4")
        self.assertEqual(by_name, self.stats_after("--technique", "thesis_8x8", "--set", "filter.taps=4"))
        error = self.refuse("render", POSTS, "-o", self.folder / "x.png", "--preset", "thesi")
        self.assertIn("did you mean 'thesis'", error)
        # A file of that name comes first.
        (self.folder / "thesis").write_text("sun.angle = 7\n")
        self.succeed("render", POSTS, "-o", "y.png", *SMALL, "--preset", "thesis", "--stats", "y.json", cwd=self.folder)
        self.assertEqual(json.loads((self.folder / "y.json").read_text())["params"]["sun.angle"], 7)

    def test_exposure_takes_a_value_or_auto(self):
        values = self.stats_after("--exposure", "12.5")
        self.assertEqual((values["exposure.auto"], values["exposure.ev"]), (False, 12.5))
        self.assertTrue(self.stats_after("--exposure", "auto")["exposure.auto"])

    def test_a_saved_preset_draws_the_same_bytes(self):
        arguments = ["--technique", "pcf", "--sun-angle", "1.1", "--set", "bias.slope=0.3"]
        saved, first, second = (self.folder / name for name in ("p.toml", "a.png", "b.png"))
        self.succeed("render", POSTS, "-o", first, *SMALL, *arguments, "--save-preset", saved)
        self.succeed("render", POSTS, "-o", second, *SMALL, "--preset", saved)
        self.assertEqual(first.read_bytes(), second.read_bytes())


if __name__ == "__main__":
    main()
