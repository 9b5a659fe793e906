"""Every command that the README shows works as it stands there.

The blocks marked `sh` run in a copy of the tree, in order, one shell each. ./run.sh is the real script, except that it
finds the program built already.
"""

import os
import pathlib
import re
import shutil
import subprocess

import desktop
import support

BLOCK = re.compile(r"^```sh\n(.*?)^```", re.MULTILINE | re.DOTALL)
NOT_COPIED = shutil.ignore_patterns("build", "out", ".git", "__pycache__")

# What a test of the suite can't do: start the suite, or fetch the project.
LEFT_OUT = ("./test.sh", "git clone", "cd penumbra")

SETUP = """
note() { printf '%s\\n' "$*" >&2; }
ensure_packages() { :; }
build_lock() { :; }
build_unlock() { :; }
configured() { :; }
build() { :; }
"""


# Commands that run until Ctrl-C, which ends them with exit code 130.
ENDLESS = ("./run.sh watch ", "./run.sh view ")


def commands(block):
    lines = []
    for line in block.splitlines():
        if line.startswith(ENDLESS):
            line = f"code=0; timeout --preserve-status --signal=INT 20 {line} || code=$?; test $code = 130"
        if not line.startswith(LEFT_OUT):
            lines.append(line + "\n")
    return "".join(lines)


class Readme(support.TestCase):
    def test_commands(self):
        blocks = BLOCK.findall((support.ROOT / "README.md").read_text())
        self.assertGreater(len(blocks), 0, "README.md shows no command")
        tree = self.folder / "penumbra"
        shutil.copytree(support.ROOT, tree, ignore=NOT_COPIED)
        (tree / "scripts" / "setup.sh").write_text(SETUP)
        (tree / "build" / "release").mkdir(parents=True)
        program = pathlib.Path(support.PROGRAM)
        (tree / "build" / "release" / "penumbra").symlink_to(program)
        with desktop.Desktop() as screen:
            environment = {**os.environ, "PATH": f"{program.parent}:{os.environ['PATH']}", "DISPLAY": screen.name,
                           "XDG_CONFIG_HOME": str(self.folder / "config")}
            for block in blocks:
                with self.subTest(block=block):
                    result = subprocess.run(["bash", "-euo", "pipefail", "-c", commands(block)], cwd=tree,
                                            env=environment, capture_output=True, text=True, timeout=600)
                    self.assertEqual(result.returncode, 0, result.stdout + result.stderr)


if __name__ == "__main__":
    support.main()
