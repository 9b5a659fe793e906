"""The manual page and the completion scripts, which are made from the options of the commands."""

import re
import shutil
import subprocess
import unittest

import shells
import support

MANUAL = support.BUILD / "manual"


def page_text():
    """The manual page as a reader sees it, without breaks and bold letters."""
    page = subprocess.run(["groff", "-man", "-Tutf8", "-Kutf8", "-P-cbou", "-rLL=1000n", MANUAL / "penumbra.1"],
                          capture_output=True, text=True, check=True).stdout
    return " ".join(re.sub(r"[‐−]", "-", page).split())


class ManualPage(support.TestCase):
    def test_reads_without_warnings(self):
        for program, command in {
            "man": ["man", "--warnings", "-E", "UTF-8", "-l", "-Tutf8", "-Z", MANUAL / "penumbra.1"],
            "groff": ["groff", "-man", "-ww", "-b", "-z", "-Kutf8", "-Tutf8", MANUAL / "penumbra.1"],
        }.items():
            with self.subTest(program):
                if not shutil.which(program):
                    self.skipTest(f"{program} is not installed")
                result = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
                self.assertEqual((result.returncode, result.stderr), (0, ""))

    @unittest.skipUnless(shutil.which("groff"), "groff is not installed")
    def test_has_all_that_the_help_has(self):
        page = page_text()
        overview = self.succeed("--help").stdout
        for command, summary in re.findall(r"(?m)^  (\w+) +(\S.*)$", overview):
            with self.subTest(command):
                self.assertTrue(f"penumbra {command}" in page)
                for option in re.findall(r"(?m)^  (?:-\w,)?(--[\w-]+)", self.succeed(command, "--help").stdout):
                    self.assertTrue(option in page, option)
        for what in ("techniques", "filters", "denoisers", "params", "aovs"):
            for row in self.listed(what):
                with self.subTest(row["name"]):
                    self.assertTrue(row["name"] in page)
                    self.assertTrue(" ".join(row["help"].split()) in page, row["help"])


class Completion(support.TestCase):
    def shell(self, name):
        shell = shells.Shell(name, self.folder)
        self.addCleanup(shell.close)
        shells.load_completion(shell, name, MANUAL)
        return shell

    def check(self, name):
        for file in ("sky.glb", "sea.gltf", "notes.txt"):
            (self.folder / file).touch()
        (self.folder / "scenes").mkdir()
        shell = self.shell(name)
        for line, words in {
            "penumbra ren": ["render"],
            "penumbra bake noi": ["bake", "noise"],
            "penumbra bake noise --ki": ["bake", "noise", "--kind"],
            "penumbra plan compare --orb": ["plan", "compare", "--orbit"],
            "penumbra render sk": ["render", "sky.glb"],
            "penumbra info sc": ["info", "scenes" if name == "zsh" else "scenes/"],  # zsh takes the slash away again
            "penumbra render sky.glb --techni": ["render", "sky.glb", "--technique"],
            "penumbra render sky.glb --technique slices_d": ["render", "sky.glb", "--technique", "slices_denoised"],
            "penumbra render sky.glb --technique=slices_d": ["render", "sky.glb", "--technique=slices_denoised"],
            "penumbra render --ground au": ["render", "--ground", "auto"],
            "penumbra render --set sun.ang": ["render", "--set", "sun.angle="],
            "penumbra render --set filter.visibility=isop": ["render", "--set", "filter.visibility=isophote"],
            "penumbra render --aov color,penu": ["render", "--aov", "color,penumbra"],
            "penumbra render --preset not": ["render", "--preset", "notes.txt"],
            "penumbra help casters.sk": ["help", "casters.skies"],
            "penumbra diff a.png b.png --metric psnr_": ["diff", "a.png", "b.png", "--metric", "psnr_penumbra"],
        }.items():
            with self.subTest(f"{name}: {line}"):
                self.assertEqual(shell.completed(line), ["penumbra", *words])

    def test_bash_completes_command_lines(self):
        self.check("bash")
        shell = self.shell("bash")  # zsh offers all files where none is a scene
        self.assertEqual(shell.completed("penumbra render no"), ["penumbra", "render", "no"])

    def test_zsh_completes_command_lines(self):
        self.check("zsh")

    def test_every_command_is_offered(self):
        shell = self.shell("bash")
        offered = shell.run("_penumbra_commands").split()
        for command in re.findall(r"(?m)^  (\w+) ", self.succeed("--help").stdout):
            self.assertIn(command, offered)


if __name__ == "__main__":
    support.main()
