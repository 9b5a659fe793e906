"""The stand-alone benchmarks run and print what they measure; how long anything takes is no matter of a test."""

import json
import subprocess
import unittest

from support import BUILD, ROOT, TestCase, main


class Bench(TestCase):
    def bench(self, name, *arguments):
        run = subprocess.run([BUILD / "bench" / f"bench_{name}", *arguments], capture_output=True, text=True, timeout=300)
        self.assertEqual(run.returncode, 0, run.stderr)
        return run.stdout

    def test_movement_map_prints_memory_and_costs(self):
        text = self.bench("movement_map", ROOT / "scenes" / "moving.glb", "1")
        for form in ("maximum", "average"):
            self.assertIn(form, text)

    def test_cpu_parts_are_measured(self):
        if not (BUILD / "bench" / "bench_cpu").exists():
            raise unittest.SkipTest("built without Google Benchmark")
        text = self.bench("cpu", "--benchmark_format=json", "--benchmark_min_time=0.01",
                          "--benchmark_filter=courtyard|metric|noise/(void_and_cluster/32|blue/16)")
        parts = {each["name"].split("/")[0]: each for each in json.loads(text)["benchmarks"]}
        self.assertEqual(set(parts), {"read_gltf", "bake_noise", "build_tree", "trace_rays", "metric"})
        self.assertGreater(parts["trace_rays"]["rays"], 0)


if __name__ == "__main__":
    main()
