"""The program takes the command lines of the scripts that make the documentation's pictures and figures: each is planned
instead of drawn."""

import importlib.util
import pathlib
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


if __name__ == "__main__":
    main()
