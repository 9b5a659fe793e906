#include "shadow_map.h"

#include <optional>

#include "movement_map.h"

namespace penumbra::shadow {

gl::TextureDesc shadow_map_desc(const LightProjection& projection) {
  return {.target = GL_TEXTURE_2D_ARRAY,
          .format = GL_DEPTH_COMPONENT32F,
          .width = projection.size(),
          .height = projection.size(),
          .layers = projection.layers()};
}

const gl::Texture& shadow_map_target(gl::Device& device, std::string_view name, const LightProjection& projection) {
  return device.target(name, shadow_map_desc(projection));
}

std::optional<gl::TexelRect> drawn_rect(const LightProjection& projection, int layer) {
  const TexelRange drawn = projection.drawn_texels(layer);
  const glm::ivec2 size = drawn.last - drawn.first + 1;
  if (size == glm::ivec2(projection.size())) return std::nullopt;
  return gl::TexelRect{.x = drawn.first.x, .y = drawn.first.y, .width = size.x, .height = size.y};
}

void draw_shadow_map(gl::Device& device, const ShadowMapInputs& inputs) {
  for (int i = 0; i < inputs.projection.layers(); ++i) {
    if (inputs.kept[static_cast<size_t>(i)]) continue;
    gl::PassDesc desc{.name = "shadow map",
                      .depth = gl::Attachment{.texture = &inputs.map, .layer = i, .clear = glm::vec4(1)},
                      .depth_test = gl::DepthTest::less_equal,
                      .depth_write = true,
                      .depth_reversed = inputs.projection.drawn_reversed()};
    desc.scissor = drawn_rect(inputs.projection, i);
    const CullVolume cull = inputs.projection.cull_volume(i);
    const bool marks = inputs.moved != nullptr && may_hold_moved(cull, inputs.moved_bounds);
    if (marks) desc.colors = {{.texture = inputs.moved, .layer = i, .clear = glm::vec4(0)}};
    gl::Pass pass(device, desc);
    const CasterKind kind = marks ? CasterKind::depth_and_moved : CasterKind::depth;
    inputs.draw({.kind = kind,
                 .layer = i,
                 .world_to_clip = inputs.projection.casters_to_clip(i),
                 .anchored = inputs.projection.anchored_to_clip(i),
                 .cull = cull,
                 .source = inputs.source},
                pass);
  }
}

}  // namespace penumbra::shadow
