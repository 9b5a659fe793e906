"""The page of penumbra bench in a browser: bars of each technique's passes, on wide and narrow screens."""

import json

import browser
from support import ROOT, TestCase, main, run, temporary_folder

TECHNIQUES = ["hard", "pcss", "slices_denoised"]


class Page(TestCase):
    @classmethod
    def setUpClass(cls):
        folder = temporary_folder()
        cls.addClassCleanup(folder.cleanup)
        cls.page, cls.data = f"{folder.name}/bench.html", f"{folder.name}/bench.json"
        result = run("bench", ROOT / "scenes" / "steps.glb", "--technique", ",".join(TECHNIQUES), "--size", "64x36",
                     "--set", "cascades.size=64", "--frames", "3", "-o", cls.page, "-o", cls.data)
        assert result.returncode == 0, result.stderr
        cls.browser = browser.Browser()
        cls.browser.__enter__()
        cls.addClassCleanup(cls.browser.__exit__)

    def setUp(self):
        self.browser.resize(1280, 800)
        self.browser.open(self.page)

    def tearDown(self):
        self.assertEqual(self.browser.log(), [])

    def test_each_bar_is_as_long_as_its_passes_take(self):
        widths = self.browser.script(
            "const bars = {}; for (const part of document.querySelectorAll('.plot rect')) {"
            "const bar = part.querySelector('title').textContent.split(':')[0];"
            "bars[bar] = (bars[bar] || 0) + part.getBoundingClientRect().width; } return bars;")
        costs = json.load(open(self.data, encoding="utf-8"))["points"][0]["costs"]
        sums = {cost["label"]: sum(each["median_ms"] for each in cost["passes"] if "/" not in each["name"])
                for cost in costs}
        self.assertEqual(sorted(widths), sorted(TECHNIQUES))
        for name in TECHNIQUES:
            self.assertAlmostEqual(widths[name] / widths["hard"], sums[name] / sums["hard"], delta=0.03 * sums[name] / sums["hard"])
        colours = self.browser.script("return Array.from(document.querySelectorAll('.plot .key span'),"
                                      "spot => getComputedStyle(spot).backgroundColor)")
        self.assertEqual(len(set(colours)), len(colours))
        self.assertNotIn("rgba(0, 0, 0, 0)", colours)

    def test_it_can_be_used_on_a_narrow_screen(self):
        self.browser.resize(400, 800)
        self.assertEqual(self.browser.script("return document.documentElement.scrollWidth"), 400)
        right = self.browser.script("const plot = document.querySelector('.plot'); plot.scrollLeft = 9999;"
                                    "return plot.querySelector('.key').getBoundingClientRect().right")
        self.assertLess(right, 400)  # the names of the colours do not scroll away
        self.assertGreater(self.browser.script("return document.querySelector('.plot').scrollLeft"), 100)


if __name__ == "__main__":
    main()
