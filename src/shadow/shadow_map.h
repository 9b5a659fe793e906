#pragma once

#include <string>

#include "../gl/pass.h"
#include "inputs.h"

namespace penumbra::shadow {

struct ShadowMapInputs {
  std::string name;  // of the target: one map a light
  const LightProjection& projection;
  const DrawCasters& draw;
  // Level 0 of a movement map: takes the present position of what moved as a second target. What moved lies within
  // `moved_bounds` (see Inputs::moved); layers that do not hold it stay as they are.
  const gl::Texture* moved = nullptr;
  std::optional<Box> moved_bounds;
};

// Depth of the casters: DEPTH_COMPONENT32F array, the layers of the projection, linear, near 0, far 1.
const gl::Texture& draw_shadow_map(gl::Device& device, const ShadowMapInputs& inputs);

}  // namespace penumbra::shadow
