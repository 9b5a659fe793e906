#pragma once

#include <optional>
#include <string_view>

#include "../gl/pass.h"
#include "inputs.h"
#include "kept_maps.h"

namespace penumbra::shadow {

// A DEPTH_COMPONENT32F array with the layers of a projection.
gl::TextureDesc shadow_map_desc(const LightProjection& projection);
// The texture of that name and form, which draw_shadow_map() fills.
const gl::Texture& shadow_map_target(gl::Device& device, std::string_view name, const LightProjection& projection);

// The texels of a layer that casters are drawn to, as a scissor box; nothing if these are all.
std::optional<gl::TexelRect> drawn_rect(const LightProjection& projection, int layer);

struct ShadowMapInputs {
  const gl::Texture& map;  // of shadow_map_target()
  const LightProjection& projection;
  LightSource source = {};
  const DrawCasters& draw;
  // Level 0 of a movement map, into which the same passes draw the casters that moved, at their present positions.
  // These lie within `moved_bounds` (see Inputs::moved); layers outside of the bounds are not changed.
  const gl::Texture* moved = nullptr;
  std::optional<Box> moved_bounds;
  LayerSet kept;  // these layers are not drawn
};

// Draws the depth of the casters: linear, near 0, far 1.
void draw_shadow_map(gl::Device& device, const ShadowMapInputs& inputs);

}  // namespace penumbra::shadow
