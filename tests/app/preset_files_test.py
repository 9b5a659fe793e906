"""Every preset of the program is also a file of presets/, and means the same."""

from pictures import SMALL, scene
from support import ROOT, TestCase, main

FILES = sorted((ROOT / "presets").glob("*.toml"))
FRAMES = ["--frames", "0:2", "--fps", "30"]


class PresetFiles(TestCase):
    def settings(self, *arguments):
        saved = self.folder / "saved.toml"
        self.succeed("render", scene("steps"), "-o", self.folder / "x.png", "--size", "8x8", "--quiet", "--save-preset",
                     saved, *arguments)
        text = saved.read_text()
        saved.unlink()
        return text

    def test_files_are_the_presets_of_the_program(self):
        self.assertTrue(FILES)
        for path in FILES:
            with self.subTest(path.name):
                self.assertEqual(self.settings("--preset", path), self.settings("--technique", path.stem))

    def test_every_preset_but_single_parameters_has_a_file(self):
        rows = self.listed("techniques")
        presets = {row["name"] for row in rows if "sets" in row and row["name"] != "pcss_compute"} | {"brute_force"}
        self.assertEqual({path.stem for path in FILES}, presets)

    def test_a_sequence_with_a_history_is_the_same_twice_and_under_both_drivers(self):
        pictures = {}
        for name in ("thesis", "thesis", "thesis_compute"):
            self.succeed("render", scene("moving"), "-o", self.folder / "x_#.png", "--technique", name, *SMALL,
                         *FRAMES, "--quiet")
            drawn = [path.read_bytes() for path in sorted(self.folder.glob("x_*.png"))]
            self.assertEqual(len(drawn), 3)
            self.assertEqual(pictures.setdefault("first", drawn), drawn, name)


if __name__ == "__main__":
    main()
