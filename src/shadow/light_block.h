#pragma once

#include <glm/glm.hpp>

#include "depth_precision.h"
#include "light_frame.h"
#include "samples.h"
#include "shared/shadow_block.h"

namespace penumbra::shadow {

// Values for the uniform block that come from a light's state.
struct LightTraits {
  NoiseRead noise;
  glm::vec2 last_jitter{0};
  NdcError depth_error;
  float vertex_rounding = 0;        // see ShadowBlock
  bool made_normals = false;        // from depths, since the caller brings none
  bool moved_maps = false;          // see moves_maps()
  DepthRounding map_rounding = {};  // by the format of the caller's maps; 0 of Penumbra's own
};

// The contents of the uniform block that the shadow passes read for one view and one light.
glsl::ShadowBlock shadow_block(const Inputs& inputs, const LightFrame& light, const LightTraits& traits);

}  // namespace penumbra::shadow
