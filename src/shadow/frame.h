#pragma once

#include "left_out.h"
#include "light_work.h"

namespace penumbra::shadow {

struct MaskInputs {
  gl::Device& device;
  const Registry& registry;
  const Programs& programs;
  Samples& samples;
  LeftOut& left_out;
  const ParamSet& defaults;  // the registry's parameters with their default values
  const Inputs& inputs;
  const ParamSet& params;
};

// Runs a whole frame of the shadow library: draws the maps of every light and fills the mask, one layer for each light.
Mask draw_mask(const MaskInputs& inputs, ViewState& view);

}  // namespace penumbra::shadow
