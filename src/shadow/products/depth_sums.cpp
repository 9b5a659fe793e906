#include "../pass_context.h"
#include "../recipe.h"

namespace penumbra::shadow {

namespace {

constexpr int invocations = 64;  // of a work group, which sums a row or a column

// RGBA32UI; texel (x, y) holds the sums over all blocks from (0, 0) to (x, y): of depth in fixed point, lower and
// higher word, and of its square.
const gl::Texture& build(const PassContext& context) {
  const LightProjection& projection = context.frame().projection;
  const int side = (projection.size() - 1) / context.params().get_int("depth_sums.shrink") + 1;
  const gl::Texture& sums = context.target("sums", {.target = GL_TEXTURE_2D_ARRAY,
                                                    .format = GL_RGBA32UI,
                                                    .width = side,
                                                    .height = side,
                                                    .layers = projection.layers()});
  gl::Pass pass(context.device(), {.name = "depth sums"});
  for (const char* program : {"rows", "columns"}) {
    context.use(pass, program);
    sums.bind_image(0, GL_READ_WRITE);
    pass.dispatch(invocations, side, projection.layers());
  }
  return sums;
}

gl::ProgramDesc program(const char* name, const char* rows) {
  return {.name = name, .compute = "shadow/depth_sums.comp", .defines = {{"ROWS", rows}}};
}

}  // namespace

Recipe depth_sums() {
  using enum ParamBinding;
  return {
      .name = "depth_sums",
      .summary = "Summed-area table of stored depth and of its square, as integers modulo 2^64, which lose nothing.",
      .source =
          "Hensley et al. 2005, Fast summed-area table generation; Lauritzen 2007, Summed-area variance shadow "
          "maps",
      .params =
          {{"depth_sums.shrink", 2, 1, 8, "texels",
            "Texels of the shadow map along each side of the block that one entry of the table, 16 bytes, sums up.",
            compiled}},
      .depends_only_on_needs = true,
      .build = build,
      .programs = [](const ParamSet&) {
        return std::vector<gl::ProgramDesc>{program("rows", "1"), program("columns", "0")};
      }};
}

}  // namespace penumbra::shadow
