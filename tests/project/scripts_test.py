"""The program takes the command lines of the scripts that make the documentation's pictures and figures: each is planned
instead of drawn. And the script that checks pictures on build servers."""

import importlib.util
import os
import pathlib
import shutil
import subprocess
import types

from support import PROGRAM, ROOT, TestCase, main


class Scripts(TestCase):
    def script(self, name):
        """A script as a module, whose commands are planned."""
        spec = importlib.util.spec_from_file_location(f"script_{name}", ROOT / "scripts" / f"{name}.py")
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        module.subprocess = types.SimpleNamespace(run=self.plan)
        self.planned = 0
        return module

    def plan(self, command, **_):
        _, name, *arguments = map(str, command)
        if name == "diff":
            return types.SimpleNamespace(stdout='{"figures": {"rmse": 1}}')
        arguments[arguments.index("-o") + 1] = str(self.folder / "plan.json")
        with self.subTest(" ".join(arguments)):
            self.succeed("plan", name, *arguments, cwd=ROOT)
        self.planned += 1
        return None

    def test_pictures(self):
        pictures = self.script("pictures")
        for name in pictures.PICTURES:
            self.plan([PROGRAM, "render", *pictures.options_of(name)[0], "-o", "p.png", "--quiet"])
        self.assertGreater(self.planned, 50)

    def test_comparison(self):
        comparison = self.script("comparison")
        comparison.compare(PROGRAM, self.folder, comparison.TECHNIQUES)
        comparison.compare(PROGRAM, self.folder, [row for name in comparison.LADDERS for row in comparison.settings_of(name)])
        self.assertEqual(self.planned, 2)

    def test_convergence(self):
        convergence = self.script("convergence")
        self.assertEqual(list(convergence.errors(PROGRAM)), [1] * len(convergence.RAYS))
        self.assertEqual(self.planned, 1 + len(convergence.RAYS))

    def test_terminator(self):
        self.script("terminator").render(PROGRAM, pathlib.Path("p.png"), ["scenes/moving.glb"], "true")
        self.assertEqual(self.planned, 1)

    def check_pictures(self, *arguments):
        environment = {**os.environ, "PENUMBRA": str(PROGRAM), "SCENES": str(self.folder / "scenes"),
                       "RECORDED": str(self.folder / "recorded"), "RESULTS": str(self.folder / "results")}
        result = subprocess.run([ROOT / "docs" / "ci" / "check_pictures.sh", *arguments, "--technique", "hard"],
                                env=environment, capture_output=True, text=True, check=False)
        return result.returncode, result.stderr

    def test_pictures_of_scenes_are_checked_whatever_their_names(self):
        (self.folder / "scenes").mkdir()
        self.assertEqual(self.check_pictures()[0], 1, "there is no scene")
        own = self.folder / "scenes" / "steps [1]#2.glb"
        shutil.copy(ROOT / "scenes" / "steps.glb", own)
        self.assertEqual(self.check_pictures("--record"), (0, ""))
        self.assertEqual(self.check_pictures(), (0, ""))
        changed = self.check_pictures("--sun", "30,40")
        self.assertEqual(changed[0], 1)
        self.assertIn("changed: steps [1]#2", changed[1])
        twin = own.with_suffix(".gltf")
        shutil.copy(own, twin)
        self.assertIn("would have the same picture", self.check_pictures()[1])
        twin.unlink()
        own.unlink()
        shutil.copy(ROOT / "scenes" / "steps.glb", self.folder / "scenes" / "other.glb")
        self.assertIn("without a scene", self.check_pictures()[1])


if __name__ == "__main__":
    main()
