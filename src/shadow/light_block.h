#pragma once

#include <glm/glm.hpp>

#include "shared/shadow_block.h"
#include "technique.h"

namespace penumbra::shadow {

// What the GLSL of the shadow passes reads of a view and a light.
glsl::ShadowBlock shadow_block(const Inputs& inputs, const LightFrame& light, bool square);

// The sample points of a technique under these parameters; `rotated`: disc points, else points of the unit square.
struct Sampling {
  bool rotated = true;
  glsl::SampleBlock points{};
};
Sampling sampling_of(const Technique& technique, const ParamSet& params);

}  // namespace penumbra::shadow
