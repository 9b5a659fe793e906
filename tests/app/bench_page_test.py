"""The page of penumbra bench in a browser: bars of each technique's passes, on wide and narrow screens."""

import json
import pathlib

import browser
from support import ROOT, main, run, temporary_folder

TECHNIQUES = ["hard", "pcss", "slices_denoised"]


class Page(browser.PageTest):
    @classmethod
    def make_page(cls):
        folder = temporary_folder()
        cls.addClassCleanup(folder.cleanup)
        cls.page, cls.data = f"{folder.name}/bench.html", f"{folder.name}/bench.json"
        result = run("bench", ROOT / "scenes" / "steps.glb", "--technique", ",".join(TECHNIQUES), "--size", "64x36",
                     "--set", "cascades.size=64", "--frames", "3", "-o", cls.page, "-o", cls.data)
        assert result.returncode == 0, result.stderr

    def test_each_bar_is_as_long_as_its_passes_take(self):
        widths = self.browser.script(
            "const bars = {}; for (const part of document.querySelectorAll('.plot rect')) {"
            "const bar = part.querySelector('title').textContent.split(':')[0];"
            "bars[bar] = (bars[bar] || 0) + part.getBoundingClientRect().width; } return bars;")
        costs = json.loads(pathlib.Path(self.data).read_text(encoding="utf-8"))["points"][0]["costs"]
        sums = {cost["label"]: sum(each["median_ms"] for each in cost["passes"] if "/" not in each["name"])
                for cost in costs}
        self.assertEqual(sorted(widths), sorted(TECHNIQUES))
        for name in TECHNIQUES:
            ratio = sums[name] / sums["hard"]
            self.assertAlmostEqual(widths[name] / widths["hard"], ratio, delta=0.03 * ratio)
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
