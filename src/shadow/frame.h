#pragma once

#include "light_work.h"

namespace penumbra::shadow {

struct MaskInputs {
  gl::Device& device;
  const Registry& registry;
  const Programs& programs;
  Samples& samples;
  const ParamSet& defaults;  // of the registry's rows
  const Inputs& inputs;
  const ParamSet& params;
};

// The frame of the shadow library: from what the caller gives to the mask, one layer a light.
Mask draw_mask(const MaskInputs& inputs, ViewState& view);

}  // namespace penumbra::shadow
