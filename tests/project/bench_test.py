"""The benchmarks run and print what they measure; how long anything takes is no matter of a test."""

import re
import subprocess

from support import BUILD, ROOT, TestCase, main


class Bench(TestCase):
    def bench(self, name, *arguments):
        run = subprocess.run([BUILD / "bench" / f"bench_{name}", *arguments], capture_output=True, text=True, timeout=300)
        self.assertEqual(run.returncode, 0, run.stderr)
        return run.stdout

    def test_presets_prints_a_row_each_whose_passes_add_up(self):
        names = ["hard", "thesis_8x8", "thesis"]
        head, columns, *rows = self.bench("presets", ROOT / "scenes" / "steps.glb", "1", *names).splitlines()
        self.assertIn("1280x720", head)
        self.assertEqual(columns.split()[0], "preset")
        self.assertEqual([row.split()[0] for row in rows], names)
        for row in rows:
            *passes, together, _ = [float(cell.rstrip("x")) for cell in row.split()[1:]]
            self.assertAlmostEqual(sum(passes), together, delta=0.05)
            self.assertGreater(together, 0)

    def test_presets_refuses_unknown_names(self):
        program = BUILD / "bench" / "bench_presets"
        run = subprocess.run([program, ROOT / "scenes" / "steps.glb", "1", "thesys"], capture_output=True, text=True)
        self.assertEqual(run.returncode, 1)
        self.assertIn("did you mean 'thesis'", run.stderr)

    def test_movement_map_prints_memory_and_costs(self):
        text = self.bench("movement_map", ROOT / "scenes" / "moving.glb", "1")
        for form in ("maximum", "average"):
            self.assertIn(form, text)

    def test_fetch_floor_prints_both_costs_and_their_ratio(self):
        text = self.bench("fetch_floor", ROOT / "scenes" / "steps.glb", "1")
        figures = re.search(r"pcss ([\d.]+) ms, its fetches alone ([\d.]+) ms, ratio ([\d.]+)", text)
        self.assertIsNotNone(figures, text)
        pcss, floor, ratio = map(float, figures.groups())
        self.assertAlmostEqual(ratio, pcss / floor, delta=0.02)


if __name__ == "__main__":
    main()
