#include <bit>

#include "../pass_context.h"
#include "../recipe.h"

namespace penumbra::shadow {

namespace {

// R32F; texel (x, y) of level l holds the greatest depth of the 4·2^l texels squared from (x, y)·4·2^l on, and 1 where
// some of these lie outside of the map.
const gl::Texture& build(const PassContext& context) {
  const LightProjection& projection = context.frame().projection;
  // A power of two, so that a texel of every level covers whole texels of the map.
  const int side = static_cast<int>(std::bit_ceil(static_cast<unsigned>((projection.size() + 3) / 4)));
  const int levels = std::bit_width(static_cast<unsigned>(side));
  const gl::Texture& pyramid = context.target("levels", {.target = GL_TEXTURE_2D_ARRAY,
                                                         .format = GL_R32F,
                                                         .width = side,
                                                         .height = side,
                                                         .layers = projection.layers(),
                                                         .levels = levels});
  gl::Pass pass(context.device(), {.name = "greatest depth pyramid"});
  for (int level = 0; level < levels; ++level) {
    context.use(pass, level == 0 ? "base" : "level");
    if (level > 0) pyramid.bind_image(0, GL_READ_ONLY, level - 1);
    pyramid.bind_image(1, GL_WRITE_ONLY, level);
    pass.dispatch(side >> level, side >> level, projection.layers());
  }
  return pyramid;
}

gl::ProgramDesc program(const char* name, const char* from_depth) {
  return {.name = name, .compute = "shadow/greatest_depth_pyramid.comp", .defines = {{"FROM_DEPTH", from_depth}}};
}

}  // namespace

Recipe greatest_depth_pyramid() {
  return {.name = "greatest_depth_pyramid",
          .summary = "Level n holds, for each block of 4·2^n × 4·2^n texels of the shadow map, the greatest depth.",
          .source = "Greene, Kass and Miller 1993, Hierarchical Z-buffer visibility",
          .depends_only_on_needs = true,
          .build = build,
          .programs = [](const ParamSet&) {
            return std::vector<gl::ProgramDesc>{program("base", "1"), program("level", "0")};
          }};
}

}  // namespace penumbra::shadow
