"""Every command that the README shows works as it stands there.

The blocks marked `sh` run in a copy of the tree, in order, one shell each. ./run.sh is the real script, except that it
finds the program built already.
"""

import os
import pathlib
import re
import shlex
import shutil
import subprocess

import desktop
import support

BLOCK = re.compile(r"^```sh\n(.*?)^```", re.MULTILINE | re.DOTALL)
NOT_COPIED = shutil.ignore_patterns("build", "out", ".git", "__pycache__")

# What a test of the suite can't do: start the suite, or fetch the project.
LEFT_OUT = ("./test.sh", "git clone", "cd penumbra")
PEERS = support.ROOT / "build" / "peers"  # where test.sh installs them, if npm can

SETUP = """
note() { printf '%s\\n' "$*" >&2; }
ensure_packages() { :; }
ensure_peers() { :; }
build_lock() { :; }
build_unlock() { :; }
configured() { :; }
build() { :; }
"""


# Commands that run until Ctrl-C.
ENDLESS = ("./run.sh watch ", "./run.sh view ")
INTERRUPTED = """
# interrupted CONDITION COMMAND...: starts an endless command, sends it the signal of Ctrl-C once the condition holds, and
# fails if that does not end it with exit code 130.
interrupted() {
  local condition=$1 code=0
  shift
  set -m  # without job control a command in the background would ignore the signal
  timeout --preserve-status --signal=INT 240 "$@" &
  until eval "$condition" >/dev/null 2>&1; do
    kill -0 $! || return 1
    sleep 0.1
  done
  kill -INT $!
  wait $! || code=$?
  set +m
  ((code == 130))
}
"""


def interrupted(line):
    """Once `watch` has written its picture, or `view` has the scene in its window."""
    words = shlex.split(line)
    if "-o" in words:
        condition = f"test -e {words[words.index('-o') + 1]}"
    else:
        scene = next(pathlib.Path(word).name for word in words if word.endswith(".glb"))
        condition = f"xdotool search --name '^{scene} - Penumbra$'"
    return f'interrupted "{condition}" {line}'


def left_out(line):
    return line.startswith(LEFT_OUT) or (line.startswith("bench/peers/") and not PEERS.exists())


def commands(block):
    lines = [interrupted(line) if line.startswith(ENDLESS) else line for line in block.splitlines()]
    return INTERRUPTED + "".join(f"{line}\n" for line in lines if not left_out(line))


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
        (tree / "build" / "peers").symlink_to(PEERS)
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
