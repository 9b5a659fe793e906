"""Many workers on one folder of results: killed at random times, stopped while they write, started by GNU parallel."""

import json
import os
import pathlib
import random
import shutil
import signal
import subprocess
import threading
import time
import unittest

from pictures import scene
from support import PROGRAM, TestCase, main, run, shader_cache

WORKERS = 8
SWEEP = (scene("steps"), scene("posts"), scene("knife_edge"), "--technique", "hard,pcf,pcss,vssm", "--spp", "8", "--size",
         "64x36", "--set", "cascades.size=256", "--no-cost", "--cache-size", "60KiB")  # two of three truths


class Workers(TestCase):
    def setUp(self):
        super().setUp()
        os.environ.pop("SLURM_ARRAY_TASK_ID", None)
        self.plan = self.folder / "sweep.json"
        # All share the cache of traced shadows too.
        self.succeed("plan", "compare", *SWEEP, "--cache", self.folder / "cache", "-o", self.plan)
        self.count = len(json.loads(self.plan.read_text())["items"])

    def start(self, *arguments, results="results"):
        return subprocess.Popen([PROGRAM, "work", self.plan, "--threads", "1", "--results", self.folder / results,
                                 *map(str, arguments)], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)

    def results(self, folder="results"):
        return {path.name: path.read_bytes() for path in (self.folder / folder).rglob("*.result")}

    def undisturbed(self):
        process = self.start(results="undisturbed")
        self.assertEqual(process.wait(timeout=300), 0, process.stderr.read())
        process.stderr.close()
        return self.results("undisturbed")

    def merged(self, folder):
        self.succeed("merge", self.plan, "--results", self.folder / folder, "-o", self.folder / "report")
        files = {path.name: path.read_bytes() for path in (self.folder / "report").iterdir()}
        shutil.rmtree(self.folder / "report")
        return files

    def test_workers_that_are_killed_do_no_damage(self):
        expected = self.undisturbed()
        self.assertEqual(len(expected), self.count)
        random.seed(18)  # of when and how they end; what they are doing then, the machine's load decides
        failures, left = [], threading.Semaphore(3 * WORKERS)  # kills

        def keep_working():
            for _ in range(100):
                process = self.start()
                delay = random.uniform(0.05, 1.5) if left.acquire(blocking=False) else None
                try:
                    process.wait(timeout=delay)
                except subprocess.TimeoutExpired:
                    process.send_signal(random.choice([signal.SIGKILL, signal.SIGKILL, signal.SIGTERM, signal.SIGINT]))
                code, error = process.wait(timeout=300), process.stderr.read()
                process.stderr.close()
                if code == 0:
                    return
                if code not in (-signal.SIGKILL, 128 + signal.SIGTERM, 128 + signal.SIGINT, -signal.SIGTERM,
                                -signal.SIGINT):
                    failures.append(f"{code}: {error}")
                    return
                # What has a result's name is whole at all times.
                for name, data in self.results().items():
                    if data != expected[name]:
                        failures.append(name)
            failures.append("no end")

        workers = [threading.Thread(target=keep_working) for _ in range(WORKERS)]
        for worker in workers:
            worker.start()
        for worker in workers:
            worker.join()
        self.assertEqual(failures, [])
        self.assertEqual(self.results(), expected)
        self.assertEqual(self.merged("results"), self.merged("undisturbed"))

    def test_a_worker_that_ends_while_it_writes_leaves_no_result(self):
        # Here writing to the disk takes very long, so that the worker certainly is at it.
        library = self.folder / "slow.so"
        subprocess.run(["c++", "-shared", "-fPIC", "-x", "c++", "-", "-o", library], text=True, check=True,
                       input='#include <unistd.h>\nextern "C" int fsync(int) { sleep(300); return 0; }\n')
        for number in (signal.SIGKILL, signal.SIGINT):
            process = subprocess.Popen([PROGRAM, "work", self.plan, "--item", "0", "--results", self.folder / "results"],
                                       env={**os.environ, "LD_PRELOAD": str(library)}, stderr=subprocess.DEVNULL)

            def written():
                return [path for path in (self.folder / "results").rglob("*") if path.is_file()]

            while process.poll() is None and not any(path.stat().st_size for path in written()):
                time.sleep(0.02)
            process.send_signal(number)
            process.wait(timeout=60)
            self.assertEqual(self.results(), {})
            self.assertEqual(len(written()), number == signal.SIGKILL, "of which nothing is left but a temporary")
            for path in written():
                self.assertRegex(path.name, r"^\.[0-9a-f]{32}\.result\.")
                path.unlink()
        self.assertEqual(self.start("--item", "0").wait(timeout=300), 0)
        self.assertEqual(list(self.results().values()), [path.read_bytes() for path in written()])

    def test_a_full_disk_leaves_no_result(self):
        limited = subprocess.run(["bash", "-c", 'ulimit -f 4; exec "$@"', "-", PROGRAM, "work", self.plan, "--item", "0",
                                  "--results", self.folder / "results"], capture_output=True, text=True, timeout=300)
        self.assertEqual(limited.returncode, 1, limited.stdout)
        self.assertRegex(limited.stderr, r"^(warning: .*\n)*error: cannot write '.*\.result': File too large\n$")
        self.assertEqual([path for path in (self.folder / "results").rglob("*") if path.is_file()], [])

    def test_all_on_one_item(self):
        processes = [self.start("--item", "0") for _ in range(WORKERS)]
        for process in processes:
            self.assertEqual(process.wait(timeout=300), 0, process.stderr.read())
            process.stderr.close()
        self.assertEqual([path.suffix for path in (self.folder / "results").rglob("*") if path.is_file()], [".result"])

    def test_a_damaged_truth_is_traced_again(self):
        expected = self.undisturbed()
        cached = list((self.folder / "cache").glob("*.truth"))
        self.assertEqual(len(cached), 2, "the limit")
        data = bytearray(cached[0].read_bytes())
        for at in range(202, len(data) // 3, 4):  # of the visibilities, the bytes before the highest ones
            data[at] ^= 0x10
        cached[0].write_bytes(data)
        cached[1].write_bytes(cached[1].read_bytes()[:1000])
        process = self.start()
        self.assertEqual(process.wait(timeout=300), 0, process.stderr.read())
        process.stderr.close()
        self.assertEqual(self.results(), expected)

    def test_gnu_parallel(self):
        if not shutil.which("parallel"):
            raise unittest.SkipTest("GNU parallel is not installed")
        expected = self.undisturbed()
        items = "\n".join(map(str, range(self.count)))
        result = subprocess.run(["parallel", "--will-cite", "--jobs", "4", PROGRAM, "work", str(self.plan), "--item", "{}",
                                 "--threads", "1", "--quiet", "--results", str(self.folder / "results")],
                                input=items, capture_output=True, text=True, timeout=300,
                                env={**os.environ, "MESA_SHADER_CACHE_DIR": shader_cache(), "HOME": str(self.folder)})
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stdout, "")
        self.assertEqual(self.results(), expected)


if __name__ == "__main__":
    main()
