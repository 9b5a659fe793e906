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
    return (line.startswith(LEFT_OUT) or (line.startswith("bench/peers/") and not PEERS.exists())
            or (line.startswith("./run.sh view ") and not support.has_viewer()))


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
        with desktop.Desktop() as screen:
            environment = {**os.environ, "DISPLAY": screen.name, "XDG_CONFIG_HOME": str(self.folder / "config")}
            if shutil.which("ccache"):  # the last run compiled the same files in a folder of another name
                environment |= {"CMAKE_CXX_COMPILER_LAUNCHER": "ccache", "CCACHE_BASEDIR": str(self.folder), "CCACHE_NOHASHDIR": "1"}
            for block in blocks:
                with self.subTest(page=page, block=block):
                    result = subprocess.run(["bash", "-euo", "pipefail", "-c", commands(block)], cwd=tree,
                                            env=environment, capture_output=True, text=True, timeout=600)
                    self.assertEqual(result.returncode, 0, result.stdout + result.stderr)

    def test_readme(self):
        self.run_page("README.md")

    def test_viewer(self):
        if not support.has_viewer():
            self.skipTest("skipped: built without the viewer")
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


class JobThatChecksPictures(support.TestCase):
    """docs/ci/pictures.yml, whose command compares with what was recorded with the same settings."""
    def test_it_fails_when_a_picture_changed_or_is_missing_or_has_no_scene(self):
        job = (support.ROOT / "docs" / "ci" / "pictures.yml").read_text()
        command, settings = re.search(r"- run: (docs/ci/\S+)\n +env:\n((?: {10}\w+: .*\n)+)", job).groups()
        settings = dict(re.findall(r"(\w+): ([^\s#]+)", settings))
        own = {name: value for name, value in os.environ.items() if name not in ("RECORDED", "RESULTS", "LIMIT")}
        self.assertEqual(settings.pop("PENUMBRA"), "build/release/penumbra")
        scenes = self.folder / settings["SCENES"]
        scenes.mkdir()
        shutil.copy(support.ROOT / "scenes" / "steps.glb", scenes)

        def check(*arguments):
            return subprocess.run([support.ROOT / command, *arguments], cwd=self.folder, capture_output=True, check=False,
                                  env={**own, **settings, "PENUMBRA": support.PROGRAM}, timeout=300).returncode

        self.assertEqual(check("--record"), 0)
        self.assertEqual(check(), 0)
        self.assertEqual(check("--sun", "30,40"), 1)
        picture, = (self.folder / "recorded").iterdir()
        of_no_scene = picture.rename(picture.with_name("removed.png"))
        self.assertEqual(check(), 1)
        shutil.copy(of_no_scene, picture)
        self.assertEqual(check(), 1)
        of_no_scene.unlink()
        self.assertEqual(check(), 0)
        shutil.rmtree(picture.parent)
        picture.parent.write_text("no folder")
        self.assertEqual(check("--record"), 1)


CODE = re.compile(r"^```.*?^```", re.MULTILINE | re.DOTALL)
LINK = re.compile(r"\]\(([^)\s]+)\)")


def anchors(page):
    """What the headings of a page are called in links, as GitHub makes it."""
    headings = re.findall(r"^#+ (.*)", CODE.sub("", page.read_text()), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def tables_of(page):
    """The lines of each table of a page in docs."""
    return [table.splitlines() for table in re.findall(r"(?:^\|.*\n)+", (support.ROOT / "docs" / page).read_text(), re.MULTILINE)]


def cells_of(line):
    return [cell.strip() for cell in line.split("|")[1:-1]]


def text_of(page):
    return " ".join((support.ROOT / page).read_text().split())


class Pages(unittest.TestCase):
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
            lines, = [lines[2:] for lines in tables_of(page) if lines[0].startswith(header)]
            return {cells[0]: cells[1:] for cells in map(cells_of, lines)}

        in_software = table("performance.md", "| pass | `courtyard` | `thesis` |")
        on_a_gpu = table("performance.md", "| pass | `courtyard`, 1280 × 720 | `thesis`, 1280 × 720 |")
        repeated = table("engines.md", "| pass |")
        self.assertGreater(len(repeated), 3)
        for name, figures in repeated.items():
            measured = in_software.get(name, ["", ""])[:2] + on_a_gpu[name][:2]
            self.assertEqual(figures, [figure.split(" → ")[-1] for figure in measured], name)
        techniques = table("performance.md", "| technique | `courtyard`: mask |")
        masks = next(row for name, row in techniques.items() if name.startswith("`slices_denoised`, `driver=compute`"))
        page = text_of("docs/engines.md")
        self.assertIn("its mask takes {} ms and its filters {} ms in `courtyard` on that GPU, {} and {} ms in `thesis`".format(
            *masks[:2], *masks[3:5]), page)

    def test_qualities_of_the_courtyard_are_those_that_were_measured(self):
        """README.md and docs/build-servers.md repeat figures of docs/techniques.md: PSNR over all, and in the penumbra."""
        figures = {}
        for lines in tables_of("techniques.md"):
            if "| `pcss` 16/16 | `thesis_8x8` | `brute_force` |" in lines[0]:
                for scene, *cells in map(cells_of, lines[2:]):
                    figures[scene] = dict(zip(cells_of(lines[0])[1:], (cell.split(" / ") for cell in cells)))
        two = {name: of[1] for name, of in figures["`courtyard` 2°"].items()}
        page = text_of("README.md")
        self.assertIn(f"`slices_denoised` has a PSNR of {two['`slices_denoised`']} dB", page)
        self.assertIn(f"`render` without `--technique` reaches {two['as `render` draws']} dB", page)
        self.assertIn(f"have {two['`pcss` 16/16']} dB with the same maps as the {two['`slices_denoised`']}", page)
        self.assertIn(f"(`brute_force`) {two['`brute_force`']} dB.", page)
        half = {name: of[0] for name, of in figures["`courtyard` 0.53°"].items()}
        page = text_of("docs/build-servers.md")
        self.assertIn(f"where `pcss` has {half['`pcss` 16/16']} and `slices_denoised` {half['`slices_denoised`']}, or "
                      f"{half['with `cascades.fit=penumbrae`']} with maps fitted to its penumbrae", page)

    def test_every_preset_has_a_row(self):
        rows, = [lines[2:] for lines in tables_of("techniques.md") if lines[0] == "| preset | values |"]
        described = {cells_of(line)[0].strip("`") for line in rows}
        files = {path.stem for path in (support.ROOT / "presets").glob("*.toml")}
        self.assertEqual({name for name in files if not name.endswith("_compute")} - described, set())
        self.assertEqual(described - files, {"…_compute"})

    def test_the_readme_stays_short(self):
        self.assertLess(len((support.ROOT / "README.md").read_text().splitlines()), 150, "docs/ has pages for more")


if __name__ == "__main__":
    support.main()
