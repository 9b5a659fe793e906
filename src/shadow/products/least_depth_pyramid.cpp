#include <bit>

#include "../pass_context.h"
#include "../recipe.h"

namespace penumbra::shadow {

namespace {

// RG32F; texel (x, y) of level l holds the least depth of the 4·2^l texels squared from (x, y)·4·2^l on, and the least
// depth beside an edge among them (1 if they have none).
const gl::Texture& build(const PassContext& context) {
  const LightProjection& projection = context.frame().projection;
  const int layers = projection.layers();
  // A power of two, so that a texel of every level covers whole texels of the map.
  const int side = static_cast<int>(std::bit_ceil(static_cast<unsigned>((projection.size() + 3) / 4)));
  const int levels = std::bit_width(static_cast<unsigned>(side));
  const gl::Texture& pyramid = context.target("levels", {.target = GL_TEXTURE_2D_ARRAY,
                                                         .format = GL_RG32F,
                                                         .width = side,
                                                         .height = side,
                                                         .layers = layers,
                                                         .levels = levels});
  gl::Pass pass(context.device(), {.name = "depth pyramid"});
  context.use(pass, "base");
  pyramid.bind_image(1, GL_WRITE_ONLY, 0);
  pass.dispatch(side, side, layers);
  context.use(pass, "level");
  for (int level = 1; level < levels; ++level) {
    pyramid.bind_image(0, GL_READ_ONLY, level - 1);
    pyramid.bind_image(1, GL_WRITE_ONLY, level);
    pass.dispatch(side >> level, side >> level, layers);
  }
  return pyramid;
}

gl::ProgramDesc program(const char* name, const char* from_depth) {
  return {.name = name, .compute = "shadow/depth_pyramid.comp", .defines = {{"FROM_DEPTH", from_depth}}};
}

}  // namespace

Recipe least_depth_pyramid() {
  return {.name = "least_depth_pyramid",
          .summary =
              "Level n holds, for each block of 4·2^n × 4·2^n texels of the shadow map, the least depth and the least "
              "depth beside an edge.",
          .source = "Greene, Kass and Miller 1993, Hierarchical Z-buffer visibility",
          .depends_only_on_needs = true,
          .build = build,
          .programs = [](const ParamSet&) {
            return std::vector<gl::ProgramDesc>{program("base", "1"), program("level", "0")};
          }};
}

}  // namespace penumbra::shadow
