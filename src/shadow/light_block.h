#pragma once

#include <glm/glm.hpp>

#include "light_frame.h"
#include "shared/shadow_block.h"

namespace penumbra::shadow {

// What a light's state says of a frame.
struct LightTraits {
  glm::vec4 noise_shift{0};  // see samples.h
  glm::vec2 last_jitter{0};
};

// What the GLSL of the shadow passes reads of a view and a light.
glsl::ShadowBlock shadow_block(const Inputs& inputs, const LightFrame& light, const LightTraits& traits);

}  // namespace penumbra::shadow
