#include <fmt/format.h>

#include <bit>

#include "../pass_context.h"
#include "../recipe.h"

namespace penumbra::shadow {

namespace {

constexpr int base_shift = 2;  // 4 texels of the map along a side

// Everything empty.
void clear(const gl::Texture& pyramid) {
  constexpr glm::vec2 empty(1);
  for (int level = 0; level < pyramid.desc().levels; ++level)
    gl::glClearTexImage(pyramid.id(), level, GL_RG, GL_FLOAT, &empty);
}

// Limits a level to what casters were drawn to: the program begins at its first texel in each layer. Returns its
// largest size.
glm::ivec2 set_region(const gl::Program& program, const LightProjection& projection, int shift) {
  glm::ivec2 largest(0);
  for (int i = 0; i < projection.layers(); ++i) {
    const TexelRange drawn = projection.drawn_texels(i);
    program.set(fmt::format("drawn[{}]", i), glm::vec4(drawn.first, drawn.last));
    largest = glm::max(largest, (drawn.last >> shift) - (drawn.first >> shift) + 1);
  }
  program.set("level_shift", shift);
  return largest;
}

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
  clear(pyramid);
  for (int level = 0; level < levels; ++level) {
    const gl::Program& program = context.use(pass, level == 0 ? "base" : "level");
    const glm::ivec2 size = set_region(program, projection, level + base_shift);
    if (level > 0) pyramid.bind_image(0, GL_READ_ONLY, level - 1);
    pyramid.bind_image(1, GL_WRITE_ONLY, level);
    pass.dispatch(size.x, size.y, layers);
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
          .reads_light_discs = true,
          .build = build,
          .programs = [](const ParamSet&) {
            return std::vector<gl::ProgramDesc>{program("base", "1"), program("level", "0")};
          }};
}

}  // namespace penumbra::shadow
