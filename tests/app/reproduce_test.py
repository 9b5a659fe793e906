"""reproduce: figures 2.8 to 2.14 and 4.1 to 4.13 of the thesis and its sections 2.2, 2.3 and 2.5, with verdicts that
rest on what was measured."""

import csv
import json
import re

import browser
from schemas import SchemaTest
from support import ROOT, TestCase, main, run, temporary_folder

SECTIONS = ["2.2", "2.3", "2.5"]
IDS = [*SECTIONS, *(f"2.{n}" for n in (8, 9, 10, 11, 12, 13, 14)), *(f"4.{n}" for n in range(1, 14))]
BRACKETED = re.compile(r"\(([^()]*)\)")


def heading(name):
    return f"{'Section' if name in SECTIONS else 'Figure'} {name}"


class Reproduce(SchemaTest):
    """One run for all: it takes most of a minute."""

    @classmethod
    def setUpClass(cls):
        cls.temporary = temporary_folder()
        cls.addClassCleanup(cls.temporary.cleanup)
        cls.report = f"{cls.temporary.name}/report"
        cls.result = run("reproduce", "-o", cls.report, "--quick", "--no-cache", "--size", "96x54", cwd=ROOT)
        if cls.result.returncode != 0:
            raise AssertionError(cls.result.stderr)
        with open(f"{cls.report}/figures.json", encoding="utf-8") as file:
            cls.data = json.load(file)
        with open(f"{cls.report}/index.html", encoding="utf-8") as file:
            cls.page = file.read()

    def test_every_figure_is_there(self):
        self.assertEqual([figure["id"] for figure in self.data["figures"]], IDS)
        self.assertEqual([figure["id"] for figure in self.data["figures"] if figure["kind"] == "section"], SECTIONS)
        self.assertIn(f"Of {len(IDS)} figures and sections ", self.page)
        for figure in self.data["figures"]:
            self.assertIn(f"{heading(figure['id'])}: {figure['title']}", self.page)
            self.assertGreaterEqual(len(figure["quantities"]), 1, figure["id"])

    def test_sentences_rest_on_the_figures(self):
        for figure in self.data["figures"]:
            known = {measured["text"] for measured in figure["quantities"]}
            shown = BRACKETED.findall(figure["sentence"])
            self.assertTrue(shown, figure["sentence"])
            self.assertLessEqual(set(shown), known, figure["sentence"])
            # Each part says by itself whether it holds; the verdict is what they say together.
            failed = len(re.findall(r"\) is not (above|below|at|within)", figure["sentence"]))
            held = len(re.findall(r"\) is (above|below|at|within)", figure["sentence"]))
            verdict = "confirmed" if not failed else "confirmed in part" if held else "not confirmed"
            self.assertEqual(figure["verdict"], verdict, figure["sentence"])

    def test_comparisons_are_told_as_they_are(self):
        relation = re.compile(r"\(([−\d.]+)[^()]*\) is (not )?(above|below) [^()]*\(([−\d.]+)")
        found = 0
        for figure in self.data["figures"]:
            for a, negated, word, b in relation.findall(figure["sentence"]):
                a, b = (float(text.replace("−", "-")) for text in (a, b))
                if a != b:  # equal printed values count as a tie
                    self.assertEqual(a > b, (word == "above") != bool(negated), figure["sentence"])
                    found += 1
        self.assertGreater(found, 10)

    def test_gains_that_are_called_clear_are_told_as_they_are(self):
        relation = re.compile(r"\(([\d.]+) dB\) is (not )?at least ([\d.]+) dB above [^()]*\(([\d.]+) dB\)")
        found = 0
        for figure in self.data["figures"]:
            for a, negated, margin, b in relation.findall(figure["sentence"]):
                self.assertEqual(float(a) - float(b) >= float(margin) - 1e-6, not negated, figure["sentence"])
                found += 1
        self.assertGreaterEqual(found, 4)

    def test_what_histories_and_movement_maps_do_is_measured(self):
        section, = (figure for figure in self.data["figures"] if figure["id"] == "2.5")
        measured = {quantity["name"]: quantity["value"] for quantity in section["quantities"]}
        trail = "the mean error of the trail "
        self.assertGreater(measured[f"{trail}without a movement map"], 0.05, "there is no ghost to be avoided")
        self.assertLess(measured[f"{trail}with a movement map"], measured[f"{trail}in a frame without a history"] + 0.004)
        self.assertGreater(measured["the PSNR in the penumbra of frame 16 at rest"],
                           measured["the PSNR in the penumbra of the first frame at rest"] - 0.5)
        for moves in ("a ball moves", "a ball moves under a sun of 8°", "six casters move"):
            changed = measured[f"the share of the picture whose shadow changes while {moves}"]
            refused = measured[f"the share of the picture refused while {moves}"]
            self.assertTrue(0 < changed < refused < 50, (moves, changed, refused))
        for name in (f"{trail}with a movement map", "frame 16 at rest", "refused while a ball moves"):
            self.assertIn(name, section["sentence"])

    def test_json_is_as_its_schema_says(self):
        self.check("reproduce", self.data)

    def test_csv_has_the_figures_of_json(self):
        with open(f"{self.report}/figures.csv", newline="", encoding="utf-8") as file:
            rows = [(row["figure"], row["name"], row["unit"], row["value"]) for row in csv.DictReader(file)]
        expected = [(f"{figure['kind']} {figure['id']}", measured["name"], measured["unit"], measured["value"])
                    for figure in self.data["figures"] for measured in figure["quantities"]]
        self.assertEqual([row[:3] for row in rows], [row[:3] for row in expected])
        for row, wanted in zip(rows, expected):
            self.assertEqual(float(row[3] or "nan"), float(wanted[3] if wanted[3] is not None else "nan"), row)

    def test_the_machine_and_the_references_are_on_the_page(self):
        for text in ("thesis.glb", "96 × 54", self.data["machine"]["cpu"], self.data["device"]["renderer"],
                     f"{self.data['truth_samples']} rays a pixel"):
            self.assertIn(text, self.page)

    def test_a_quick_run_says_so(self):
        self.assertIs(self.data["quick"], True)
        for text in (self.page, self.result.stdout):
            self.assertIn("a preview, not a measurement", text)

    def test_nothing_asks_the_network(self):
        self.assertEqual(re.findall(r"""(?:src|href)=['"]?(?!data:|#)[^'" >]+""", self.page), [])
        self.assertNotIn("@import", self.page)

    def test_a_browser_shows_it_without_complaint(self):
        with browser.Browser() as window:
            window.open(f"{self.report}/index.html")
            self.assertEqual(window.log(), [])
            broken = window.script("return [...document.images].filter(i => !i.complete || !i.naturalWidth).length")
            self.assertEqual(broken, 0)
            wide = window.script("return document.documentElement.scrollWidth - document.documentElement.clientWidth")
            self.assertLessEqual(wide, 0)
            cards = window.script(
                "return [...document.querySelectorAll('.overview li')].map(card => ["
                "card.querySelector('a').textContent.split(':')[0], card.querySelector(':scope > span').textContent,"
                "card.querySelector('.thumbnail img, .thumbnail svg, .thumbnail table') !== null])")
            expected = [[heading(figure["id"]), figure["verdict"], True] for figure in self.data["figures"]]
            self.assertEqual(cards, expected)
            window.resize(400, 800)
            self.assertEqual(window.script("return document.documentElement.scrollWidth"), 400)
            cut_off = window.script(
                "return [...document.querySelectorAll('.thumbnail svg')].filter(plot => "
                "plot.getBoundingClientRect().right > plot.parentElement.getBoundingClientRect().right + 1).length")
            self.assertEqual(cut_off, 0, "plots of which the overview shows a part")
            window.screenshot(browser.results_folder() / "reproduce_narrow.png")
            window.resize(1280, 800)
            titles = window.script("return [...document.querySelectorAll('h2')].map(e => e.textContent)")
            self.assertEqual([title.split(":")[0] for title in titles if title.startswith(("Figure", "Section"))],
                             [heading(name) for name in IDS])
            self.assertEqual(len(window.all("p.verdict")), len(IDS))
            window.screenshot(browser.results_folder() / "reproduce.png")


class ReproduceCounts(TestCase):
    def test_values_that_are_not_finite(self):
        shader = self.folder / "glsl" / "shadow" / "techniques" / "hard.glsl"
        shader.parent.mkdir(parents=True)
        shader.write_text("""#include "shadow/light.glsl"
float read_radius(Receiver receiver, Light light) { return 0.0; }
Visibility visibility(Receiver receiver, Light light) { return Visibility(uintBitsToFloat(0x7fc00000u), 0.0, 0.0, true, false); }
""")
        result = self.succeed("reproduce", "-o", self.folder / "report", "--quick", "--quiet", "--no-cache", "--size", "32x18",
                              "--glsl", self.folder / "glsl", cwd=ROOT)
        figures = json.loads((self.folder / "report" / "figures.json").read_text())["figures"]
        counted = {measured["name"]: measured["value"] for measured in figures[0]["quantities"] if "finite" in measured["name"]}
        self.assertEqual(list(counted), ["the number of values that are not finite of hard"])
        (count,) = counted.values()
        self.assertGreater(count, 32 * 18 / 2)
        self.assertEqual(result.stderr, f"warning: 'hard' gives values that are not finite: {count:.0f}; each counts as an "
                                        "error of 1\n")


class ReproduceRefuses(TestCase):
    def test_a_folder_that_cannot_be_written_before_anything_is_drawn(self):
        place = self.folder / "file"
        place.write_text("no folder")
        line = self.refuse("reproduce", "-o", place, "--quick", timeout=20)
        self.assertIn("file", line)
        self.assertEqual([path.name for path in self.folder.iterdir()], ["file"])

    def test_a_scene_that_is_not_there(self):
        line = self.refuse("reproduce", self.folder / "none.glb", "-o", self.folder / "report", "--quick", timeout=60)
        self.assertIn("none.glb", line)
        self.assertFalse((self.folder / "report" / "index.html").exists())

    def test_no_output(self):
        self.refuse("reproduce", code=2)
        self.assertIn("empty", self.refuse("reproduce", "-o", "", code=2))

    def test_a_cache_and_none(self):
        self.assertIn("--no-cache", self.refuse("reproduce", "-o", self.folder, "--cache", "x", "--no-cache", code=2))


if __name__ == "__main__":
    main()
