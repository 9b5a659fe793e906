#include "shadow_map.h"

#include <bit>

#include "movement_map.h"

namespace penumbra::shadow {

const gl::Texture& draw_shadow_map(gl::Device& device, const ShadowMapInputs& inputs) {
  const int count = inputs.projection.layers();
  const gl::Texture& depth = device.target(inputs.name, {.target = GL_TEXTURE_2D_ARRAY,
                                                         .format = GL_DEPTH_COMPONENT32F,
                                                         .width = inputs.projection.size(),
                                                         .height = inputs.projection.size(),
                                                         .layers = count});
  for (int i = 0; i < count; ++i) {
    gl::PassDesc desc{.name = "shadow map",
                      .depth = gl::Attachment{.texture = &depth, .layer = i, .clear = glm::vec4(1)},
                      .depth_test = gl::DepthTest::less_equal,
                      .depth_write = true};
    const CullVolume cull = inputs.projection.cull_volume(i);
    const bool marks = inputs.moved != nullptr && may_hold_moved(cull, inputs.moved_bounds);
    if (marks) desc.colors = {{.texture = inputs.moved, .layer = i, .clear = glm::vec4(0)}};
    gl::Pass pass(device, desc);
    const CasterKind kind = marks ? CasterKind::depth_and_moved : CasterKind::depth;
    inputs.draw({.kind = kind, .layer = i, .world_to_clip = inputs.projection.world_to_clip(i), .cull = cull}, pass);
  }
  return depth;
}

gl::ProgramDesc depth_pyramid_program(bool from_depth) {
  return {.name = from_depth ? "depth pyramid base" : "depth pyramid level",
          .compute = "shadow/depth_pyramid.comp",
          .defines = {{"FROM_DEPTH", from_depth ? "1" : "0"}}};
}

const gl::Texture& build_depth_pyramid(gl::Device& device, const DepthPyramidInputs& inputs) {
  // A power of two, so that a texel of every level covers whole texels of the map.
  const int side = static_cast<int>(std::bit_ceil(static_cast<unsigned>((inputs.size + 3) / 4)));
  const int levels = std::bit_width(static_cast<unsigned>(side));
  const gl::Texture& pyramid = device.target(inputs.name, {.target = GL_TEXTURE_2D_ARRAY,
                                                           .format = GL_R32F,
                                                           .width = side,
                                                           .height = side,
                                                           .layers = inputs.layers,
                                                           .levels = levels});
  gl::Pass pass(device, {.name = "depth pyramid"});
  pass.use(depth_pyramid_program(/*from_depth=*/true));
  gl::glBindTextureUnit(0, inputs.depth);
  device.sampler({}).bind(0);
  pyramid.bind_image(1, GL_WRITE_ONLY, 0);
  pass.dispatch(side, side, inputs.layers);
  pass.use(depth_pyramid_program(/*from_depth=*/false));
  for (int level = 1; level < levels; ++level) {
    pyramid.bind_image(0, GL_READ_ONLY, level - 1);
    pyramid.bind_image(1, GL_WRITE_ONLY, level);
    pass.dispatch(side >> level, side >> level, inputs.layers);
  }
  return pyramid;
}

}  // namespace penumbra::shadow
