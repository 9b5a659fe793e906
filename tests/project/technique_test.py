"""A technique, a product, a filter and a denoiser are each one .cpp, at most one GLSL file and one line of the registry: this
adds one of each to a copy of the tree."""

import shutil
import subprocess
import unittest

import support

TECHNIQUE = """#include "../technique.h"

namespace penumbra::shadow {

Technique checker() {
  return {.name = "checker",
          .summary = "Squares of light and shadow, with no regard to casters.",
          .source = "made up",
          .glsl = "shadow/techniques/checker.glsl",
          .needs = {"tenth"},
          .params = {{"checker.side", 16, 1, 256, "px", "Side of a square.", ParamBinding::uniform}}};
}

}  // namespace penumbra::shadow
"""

TECHNIQUE_GLSL = """#include "shadow/light.glsl"

layout(binding = UNIT_tenth) uniform sampler2D dark;

float read_radius(Receiver receiver, Light light) { return 0.0; }

Visibility visibility(Receiver receiver, Light light) {
  ivec2 square = ivec2(receiver.pixel) / checker_side;
  float lit = ((square.x + square.y) & 1) == 1 ? 1.0 : texelFetch(dark, ivec2(0), 0).x;
  return Visibility(lit, 0.0, 0.0, false, false);
}
"""

PRODUCT = """#include "../pass_context.h"
#include "../recipe.h"

namespace penumbra::shadow {

Recipe tenth() {
  return {.name = "tenth",
          .summary = "A texel that holds a tenth.",
          .source = "made up",
          .needs = {},
          .build = [](const PassContext& context) -> const gl::Texture& {
            const gl::Texture& texel = context.target("texel", {.format = GL_R32F});
            const gl::Attachment cleared{.texture = &texel, .clear = glm::vec4(0.1f)};
            const gl::Pass pass(context.device(), {.name = "tenth", .colors = {cleared}});
            return texel;
          }};
}

}  // namespace penumbra::shadow
"""

FILTER = """#include "../filter.h"

namespace penumbra::shadow {

Filter negative() {
  return {.name = "negative",
          .summary = "Light for shadow.",
          .source = "made up",
          .glsl = "shadow/filters/negative.glsl",
          .border = {{0, 0}}};
}

}  // namespace penumbra::shadow
"""

FILTER_GLSL = """#include "shadow/drivers/filter.glsl"

uint filtered(ivec2 pixel) { return with_visibility(texel_at(pixel), 1.0 - texel_visibility(texel_at(pixel))); }
"""

DENOISER = """#include "../denoise_context.h"
#include "../denoiser.h"

namespace penumbra::shadow {

namespace {

// The left half in shadow.
void denoise(const DenoiseContext& context) {
  const PackedMask seen = context.evaluate_packed();
  const gl::Texture& halved = context.target("halved", seen.texels.desc());
  {
    gl::Pass pass(context.device(), {.name = "halve", .colors = {{.texture = &halved}}});
    context.use(pass, "halve");
    context.device().sampler({}).bind(first_pass_unit);
    seen.texels.bind(first_pass_unit);
    pass.draw_full_screen();
  }
  context.filter_to_mask("none", {halved, seen.notes});
}

}  // namespace

Denoiser halving() {
  return {.name = "halving",
          .summary = "The left half in shadow.",
          .source = "made up",
          .denoise = denoise,
          .programs = [](const ParamSet&) {
            return std::vector<gl::ProgramDesc>{{.name = "halve",
                                                 .vertex = "shared/full_screen.vert",
                                                 .fragment = "shadow/denoisers/halving.frag"}};
          }};
}

}  // namespace penumbra::shadow
"""

DENOISER_GLSL = """#include "shadow/light.glsl"
#include "lib/packed_texel.glsl"

layout(binding = 8) uniform usampler2D seen;
layout(location = 0) out uvec2 texel;

void main() {
  texel = texelFetch(seen, ivec2(gl_FragCoord.xy), 0).xy;
  if (gl_FragCoord.x < 0.5 * shadow.viewport.z) texel.x = pack_texel(0.0, 0.0, false);
}
"""

FILES = {"src/shadow/techniques/checker.cpp": TECHNIQUE, "glsl/shadow/techniques/checker.glsl": TECHNIQUE_GLSL,
         "src/shadow/products/tenth.cpp": PRODUCT,
         "src/shadow/filters/negative.cpp": FILTER, "glsl/shadow/filters/negative.glsl": FILTER_GLSL,
         "src/shadow/denoisers/halving.cpp": DENOISER, "glsl/shadow/denoisers/halving.frag": DENOISER_GLSL}
# What is there, and what becomes the next line of the registry.
LINES = {"X(brute_force)": "X(checker)", "X(least_depth_pyramid)": "X(tenth)", "X(bilateral_separable)": "X(negative)",
         "X(history_and_filters)": "X(halving)"}
WIDTH, HEIGHT = 320, 240  # of the mask
NOT_COPIED = shutil.ignore_patterns("build", "out", ".git", "__pycache__")


def rows_of(picture):
    """The rows of a grey picture as text (PGM)."""
    values = [int(word) for word in picture.split()[4:]]
    return [values[i:i + WIDTH] for i in range(0, WIDTH * HEIGHT, WIDTH)]


class AddOneOfEach(support.TestCase):
    def test_one_cpp_one_glsl_and_one_line(self):
        tree = self.folder / "tree"
        shutil.copytree(support.ROOT, tree, ignore=NOT_COPIED)
        for name, text in FILES.items():
            file = tree / name
            file.parent.mkdir(exist_ok=True)
            file.write_text(text)
        registry = tree / "src/shadow/registry.cpp"
        text = registry.read_text()
        for last, added in LINES.items():
            self.assertEqual(text.count(last), 1, last)
            text = text.replace(last, f"{last} \\\n  {added}")
        registry.write_text(text)

        self.check_program(self.build(tree))

    def build(self, tree):
        """The library of the tree, installed, and a little program that draws with it."""
        # Where the compiler's cache knows the files that are as they were: it is as deep in its tree as other builds.
        build = tree / "build" / "release"
        prefix, mask = self.folder / "prefix", self.folder / "mask"
        for arguments in (["cmake", "-S", tree, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                           "-DPENUMBRA_APP=OFF", "-DPENUMBRA_TESTS=OFF"],
                          ["cmake", "--build", build, "--parallel", "2"],
                          ["cmake", "--install", build, "--prefix", prefix],
                          ["cmake", "-S", tree / "tests/project/mask", "-B", mask, "-G", "Ninja",
                           "-DCMAKE_BUILD_TYPE=Release", f"-DCMAKE_PREFIX_PATH={prefix}"],
                          ["cmake", "--build", mask]):
            result = subprocess.run(arguments, capture_output=True, text=True)
            self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        return mask / "mask"

    def check_program(self, program):
        def run(*arguments):
            result = subprocess.run([program, *arguments], capture_output=True, text=True)
            self.assertEqual(result.returncode, 0, result.stderr)
            return result.stdout

        listed = run("list").splitlines()
        for line in ("technique checker", "param checker.side", "filter negative", "denoiser halving", "product tenth"):
            self.assertIn(line, listed)
        for driver in ("fragment", "compute"):
            for setting, expected in (("checker.side=16", lambda lit, x: lit),
                                      ("filter.visibility=negative", lambda lit, x: not lit),
                                      ("denoiser=halving", lambda lit, x: lit and x >= WIDTH / 2)):
                with self.subTest(driver=driver, setting=setting):
                    rows = rows_of(run("technique=checker", f"driver={driver}", setting))
                    self.check_picture(rows, expected)
                    if setting == "checker.side=16":
                        self.assertGreater(min(map(min, rows)), 10, "dark squares have what the product holds")

    def check_picture(self, rows, expected):
        """Every pixel is a receiver: half of the squares are lit."""
        for y in range(8, HEIGHT, 16):
            for x in range(8, WIDTH, 16):
                # Rows of the picture run downwards, pixels of the shader upwards.
                lit = (x // 16 + (HEIGHT - 1 - y) // 16) % 2 == 1
                self.assertEqual(rows[y][x] > 127, expected(lit, x), f"pixel {x}, {y}")


if __name__ == "__main__":
    support.main()
