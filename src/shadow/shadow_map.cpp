#include "shadow_map.h"

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
    inputs.draw({.kind = kind,
                 .layer = i,
                 .world_to_clip = inputs.projection.world_to_clip(i),
                 .cull = cull,
                 .source = inputs.source},
                pass);
  }
  return depth;
}

}  // namespace penumbra::shadow
