"""The benchmarks run and print what they measure; how long anything takes is no matter of a test."""

import re
import subprocess

from support import BUILD, ROOT, TestCase, main


class Bench(TestCase):
    def test_fetch_floor_prints_both_costs_and_their_ratio(self):
        program = BUILD / "bench" / "bench_fetch_floor"
        run = subprocess.run([program, ROOT / "scenes" / "steps.glb", "1"], capture_output=True, text=True, timeout=300)
        self.assertEqual(run.returncode, 0, run.stderr)
        figures = re.search(r"pcss ([\d.]+) ms, its fetches alone ([\d.]+) ms, ratio ([\d.]+)", run.stdout)
        self.assertIsNotNone(figures, run.stdout)
        pcss, floor, ratio = map(float, figures.groups())
        self.assertAlmostEqual(ratio, pcss / floor, delta=0.02)


if __name__ == "__main__":
    main()
