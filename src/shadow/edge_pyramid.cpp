#include "edge_pyramid.h"

#include <algorithm>
#include <bit>

namespace penumbra::shadow {

namespace {

constexpr int invocation_side = 8;  // texels of the map along a side for each invocation: must match depth_blocks.glsl

// The two finest levels, of what casters were drawn to; all else is empty. Layers are dispatched one by one, since a
// software rasteriser runs the whole program in groups that have nothing to do.
void build_finest(const PassContext& context, gl::Pass& pass, const gl::Texture& pyramid) {
  constexpr glm::vec2 empty(1);
  for (int level = 0; level < 2; ++level) gl::glClearTexImage(pyramid.id(), level, GL_RG, GL_FLOAT, &empty);
  const gl::Program& program = context.use(pass, "base");
  context.device().sampler({}).bind(unit_shadow_map);
  for (int level = 0; level < 2; ++level) pyramid.bind_image(static_cast<GLuint>(level), GL_WRITE_ONLY, level);
  const LightProjection& projection = context.frame().projection;
  for (int layer = 0; layer < projection.layers(); ++layer) {
    const TexelRange drawn = projection.drawn_texels(layer);
    program.set("layer", layer);
    // Receivers of a sun read a layer that holds their whole disc, so its border could never be an edge; but where only
    // a part of the map is drawn, that would leave pixels to other layers than where all is. They read the last layer
    // although it may not hold it.
    program.set("border_is_edge", context.frame().borders_are_edges || layer + 1 == projection.layers() ? 1 : 0);
    program.set("drawn", glm::ivec4(drawn.first, drawn.last));
    const glm::ivec2 size = drawn.last / invocation_side - drawn.first / invocation_side + 1;
    pass.dispatch(size.x, size.y, 1);
  }
}

}  // namespace

const gl::Texture& build_edge_pyramid(const PassContext& context) {
  const LightProjection& projection = context.frame().projection;
  // A power of two, so that a texel of every level covers whole texels of the map.
  const int side = static_cast<int>(std::bit_ceil(static_cast<unsigned>(std::max((projection.size() + 3) / 4, 2))));
  const int levels = std::bit_width(static_cast<unsigned>(side));
  const gl::Texture& pyramid = context.target("levels", {.target = GL_TEXTURE_2D_ARRAY,
                                                         .format = GL_RG32F,
                                                         .width = side,
                                                         .height = side,
                                                         .layers = projection.layers(),
                                                         .levels = levels});
  gl::Pass pass(context.device(), {.name = "depth pyramid"});
  build_finest(context, pass, pyramid);
  for (int level = 2; level < levels; ++level) {
    context.use(pass, "level");
    pyramid.bind_image(0, GL_READ_ONLY, level - 1);
    pyramid.bind_image(1, GL_WRITE_ONLY, level);
    pass.dispatch(side >> level, side >> level, projection.layers());
  }
  return pyramid;
}

std::vector<gl::ProgramDesc> edge_pyramid_programs(const char* base) {
  return {{.name = "base", .compute = base}, {.name = "level", .compute = "shadow/depth_pyramid.comp"}};
}

}  // namespace penumbra::shadow
