"""Every command that the README and the users' pages in docs show works as it stands there, and every link leads
somewhere.

The blocks of a page that are marked `sh` run in a copy of the tree, in order, one shell each. ./run.sh is the real
script, except that it finds the program built already.
"""

import os
import pathlib
import re
import shlex
import shutil
import subprocess
import unittest

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


class Commands(support.TestCase):
    def run_page(self, page):
        blocks = BLOCK.findall((support.ROOT / page).read_text())
        self.assertGreater(len(blocks), 0, f"{page} shows no command")
        tree = self.folder / "penumbra"
        shutil.copytree(support.ROOT, tree, ignore=NOT_COPIED)
        (tree / "scripts" / "setup.sh").write_text(SETUP)
        (tree / "build").mkdir()
        (tree / "build" / "release").symlink_to(support.BUILD)
        (tree / "build" / "peers").symlink_to(PEERS)
        program = pathlib.Path(support.PROGRAM)
        with desktop.Desktop() as screen:
            environment = {**os.environ, "PATH": f"{program.parent}:{os.environ['PATH']}", "DISPLAY": screen.name,
                           "XDG_CONFIG_HOME": str(self.folder / "config")}
            for block in blocks:
                with self.subTest(page=page, block=block):
                    result = subprocess.run(["bash", "-euo", "pipefail", "-c", commands(block)], cwd=tree,
                                            env=environment, capture_output=True, text=True, timeout=600)
                    self.assertEqual(result.returncode, 0, result.stdout + result.stderr)

    def test_readme(self):
        self.run_page("README.md")

    def test_viewer(self):
        self.run_page("docs/viewer.md")

    def test_command_line(self):
        self.run_page("docs/command-line.md")

    def test_build_servers(self):
        self.run_page("docs/build-servers.md")

    def test_clusters(self):
        self.run_page("docs/clusters.md")

    def test_formats(self):
        self.run_page("docs/formats.md")

    @unittest.skipUnless((support.BUILD / "python").exists(), "skipped: built without the Python module")
    def test_python(self):
        self.run_page("docs/python.md")

    def test_library(self):
        self.run_page("docs/library.md")

    @unittest.skipUnless(support.has_openscenegraph() and support.has_ogre(),
                         "skipped: there is no OpenSceneGraph (libopenscenegraph-dev) or no OGRE (libogre-1.12-dev)")
    def test_engines(self):
        self.run_page("docs/engines.md")


CODE = re.compile(r"^```.*?^```", re.MULTILINE | re.DOTALL)
LINK = re.compile(r"\]\(([^)\s]+)\)")


def anchors(page):
    """What the headings of a page are called in links, as GitHub makes it."""
    headings = re.findall(r"^#+ (.*)", CODE.sub("", page.read_text()), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


class Links(unittest.TestCase):
    def test_every_link_leads_somewhere(self):
        folders = [support.ROOT, support.ROOT / "docs", support.ROOT / "docs" / "adr", support.ROOT / "scenes"]
        for page in [page for folder in folders for page in folder.glob("*.md")]:
            for link in LINK.findall(CODE.sub("", page.read_text())):
                if "://" in link:
                    continue
                with self.subTest(page=page.name, link=link):
                    path, _, anchor = link.partition("#")
                    target = (page.parent / path).resolve() if path else page
                    self.assertTrue(target.exists(), "there is no such file")
                    if anchor:
                        self.assertIn(anchor, anchors(target))

    def test_costs_for_engines_are_those_that_were_measured(self):
        """docs/engines.md repeats figures of docs/performance.md."""
        def table(page, header):
            tables = re.findall(r"(?:^\|.*\n)+", (support.ROOT / "docs" / page).read_text(), re.MULTILINE)
            lines, = [one.splitlines()[2:] for one in tables if one.startswith(header)]
            return {cells[0]: cells[1:] for cells in ([cell.strip() for cell in line.split("|")[1:-1]] for line in lines)}

        in_software = table("performance.md", "| pass | `courtyard` | `thesis` |")
        on_a_gpu = table("performance.md", "| pass | `courtyard`, 1280 × 720 | `thesis`, 1280 × 720 |")
        repeated = table("engines.md", "| pass |")
        self.assertGreater(len(repeated), 3)
        for name, figures in repeated.items():
            measured = in_software.get(name, ["", ""])[:2] + on_a_gpu[name][:2]
            self.assertEqual(figures, [figure.split(" → ")[-1] for figure in measured], name)
        techniques = table("performance.md", "| technique | `courtyard`: mask |")
        masks = next(row for name, row in techniques.items() if name.startswith("`slices_denoised`, `driver=compute`"))
        page = " ".join((support.ROOT / "docs" / "engines.md").read_text().split())
        self.assertIn("its mask takes {} ms and its filters {} ms in `courtyard` on that GPU, {} and {} ms in `thesis`".format(
            *masks[:2], *masks[3:5]), page)

    def test_the_readme_stays_short(self):
        self.assertLess(len((support.ROOT / "README.md").read_text().splitlines()), 150, "docs/ has pages for more")


if __name__ == "__main__":
    support.main()
