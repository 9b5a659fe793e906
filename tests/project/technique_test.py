"""A technique is one .cpp, one GLSL file and one line of the registry: this adds one to a copy of the tree."""

import shutil
import subprocess
import unittest

import support

CPP = """#include "../technique.h"

namespace penumbra::shadow {

Technique checker() {
  return {.name = "checker",
          .summary = "Squares of light and shadow, with no regard to casters.",
          .source = "made up",
          .glsl = "shadow/techniques/checker.glsl",
          .needs = needs_nothing,
          .params = {{"checker.side", 16, 1, 256, "px", "Side of a square.", ParamBinding::uniform}}};
}

}  // namespace penumbra::shadow
"""

GLSL = """#include "shadow/light.glsl"

float read_radius(Receiver receiver, Light light) { return 0.0; }

Visibility visibility(Receiver receiver, Light light) {
  ivec2 square = ivec2(receiver.pixel) / checker_side;
  return Visibility(float((square.x + square.y) & 1), 0.0, 0.0, false);
}
"""

REGISTRY_LINE = ("  X(brute_force)", "  X(brute_force) \\\n  X(checker)")
NOT_COPIED = shutil.ignore_patterns("build", "out", ".git", "__pycache__")


class AddATechnique(support.TestCase):
    def test_one_cpp_one_glsl_and_one_line(self):
        tree = self.folder / "tree"
        shutil.copytree(support.ROOT, tree, ignore=NOT_COPIED)
        (tree / "src/shadow/techniques/checker.cpp").write_text(CPP)
        (tree / "glsl/shadow/techniques/checker.glsl").write_text(GLSL)
        registry = tree / "src/shadow/registry.cpp"
        text = registry.read_text()
        self.assertEqual(text.count(REGISTRY_LINE[0]), 1)
        registry.write_text(text.replace(*REGISTRY_LINE))

        build = tree / "build/release"
        for arguments in (["cmake", "--preset", "release", "-DPENUMBRA_TESTS=OFF"],
                          ["cmake", "--build", build, "--target", "penumbra", "--parallel", "2"]):
            result = subprocess.run(arguments, cwd=tree, capture_output=True, text=True)
            self.assertEqual(result.returncode, 0, result.stdout + result.stderr)

        self.check_program(build / "penumbra", tree)

    def check_program(self, program, tree):
        def penumbra(*arguments):
            result = subprocess.run([program, *arguments], cwd=tree, capture_output=True, text=True)
            self.assertEqual(result.returncode, 0, result.stderr)
            return result.stdout

        self.assertIn("checker", penumbra("list", "techniques"))
        self.assertIn("checker.side", penumbra("list", "params"))
        # From above, every pixel is a receiver: half of the squares are lit.
        view = ["--eye", "0,20,0.01", "--target", "0,0,0", "--fov", "20", "--sun", "0,60", "--size", "64x64"]
        for driver in ("fragment", "compute"):
            picture = self.folder / f"{driver}.png"
            penumbra("render", "scenes/steps.glb", "-o", picture, "--aov", "shadow", "--technique", "checker", "--set",
                     "checker.side=16", "--set", f"driver={driver}", *view)
            self.check_picture(support.read_png(picture))

    def check_picture(self, rows):
        for y in range(8, 64, 16):
            for x in range(8, 64, 16):
                # Rows of the picture run downwards, pixels of the shader upwards.
                lit = (x // 16 + (63 - y) // 16) % 2 == 1
                self.assertEqual(rows[y][x][0] > 127, lit, f"pixel {x}, {y}")


if __name__ == "__main__":
    support.main()
