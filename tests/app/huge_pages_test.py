"""The program asks the kernel for huge pages, unless its user has set up the C library otherwise."""

import os
import pathlib
import platform
import subprocess
import time

import pictures  # sets PENUMBRA_DEBUG: an OpenGL error ends the program
from support import PROGRAM, TestCase, main

KERNEL = pathlib.Path("/sys/kernel/mm/transparent_hugepage/enabled")
VARIABLE = "GLIBC_TUNABLES"


class HugePages(TestCase):
    def setUp(self):
        super().setUp()
        if not KERNEL.exists() or "[madvise]" not in KERNEL.read_text() or platform.libc_ver()[0] != "glibc":
            self.skipTest("this system does not give huge pages to programs that ask for them")
        self.environment = {name: value for name, value in os.environ.items() if name != VARIABLE}

    def drawing(self, environment, name="penumbra"):
        """The name of a process that draws in software, and whether it has asked for huge pages for any memory."""
        link = self.folder / name
        link.symlink_to(PROGRAM)
        command = [link, "render", pictures.scene("steps"), "-o", self.folder / "x.png", "--samples", "64", "--size",
                   "1920x1080", "--backend", "osmesa"]
        with subprocess.Popen(command, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE) as process:
            folder = pathlib.Path(f"/proc/{process.pid}")
            try:
                while process.poll() is None:
                    maps = (folder / "smaps").read_text(errors="replace")
                    if maps.count("libOSMesa") > 0 and "Rss:" in maps and self._mebibytes(maps) > 200:
                        asked = any(" hg" in line for line in maps.splitlines() if line.startswith("VmFlags:"))
                        return (folder / "comm").read_text().strip(), asked
                    time.sleep(0.05)
            finally:
                process.kill()
                message = process.stderr.read()
        raise AssertionError(f"the program ended before it had drawn: {message}")

    @staticmethod
    def _mebibytes(maps):
        return sum(int(line.split()[1]) for line in maps.splitlines() if line.startswith("Rss:")) / 1024

    def test_the_program_asks_for_them_and_keeps_its_name(self):
        self.assertEqual(self.drawing(self.environment, "another_name"), ("another_name", True))

    def test_a_variable_that_is_set_is_left_alone(self):
        self.assertEqual(self.drawing(self.environment | {VARIABLE: ""}), ("penumbra", False))

    def test_it_runs_by_the_loader(self):
        loader = next(iter(pathlib.Path("/lib64").glob("ld-linux-*.so.*")), None)
        if loader is None:
            self.skipTest("no loader in /lib64")
        result = subprocess.run([loader, PROGRAM, "--version"], env=self.environment, capture_output=True, text=True,
                                timeout=60, check=True)
        self.assertRegex(result.stdout, r"^Penumbra \d")


if __name__ == "__main__":
    main()
