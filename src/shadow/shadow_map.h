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

struct DepthPyramidInputs {
  std::string name;
  unsigned depth = 0;  // name of a depth array texture
  int size = 0;        // its side, texels
  int layers = 0;
};

// Minimum depth: R32F array; texel (x, y) of level l is that of the 4·2^l texels squared from (x, y)·4·2^l on.
const gl::Texture& build_depth_pyramid(gl::Device& device, const DepthPyramidInputs& inputs);

gl::ProgramDesc depth_pyramid_program(bool from_depth);

}  // namespace penumbra::shadow
