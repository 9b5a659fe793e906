#pragma once

#include <string>

#include "../gl/pass.h"
#include "inputs.h"

namespace penumbra::shadow {

struct ShadowMapInputs {
  std::string name;  // of the target; each light has its own map
  const LightProjection& projection;
  LightSource source = {};
  const DrawCasters& draw;
  // Level 0 of a movement map, into which the same passes draw the casters that moved, at their present positions.
  // These lie within `moved_bounds` (see Inputs::moved); layers outside of the bounds are not changed.
  const gl::Texture* moved = nullptr;
  std::optional<Box> moved_bounds;
};

// Draws the depth of the casters: a DEPTH_COMPONENT32F array with the layers of the projection; linear depth, near 0,
// far 1.
const gl::Texture& draw_shadow_map(gl::Device& device, const ShadowMapInputs& inputs);

}  // namespace penumbra::shadow
