#pragma once

#include <string>

#include "light_work.h"

namespace penumbra::shadow {

// Masks of fewer pixels than the view has (parameter mask.scale): the technique and the denoiser see every scale-th
// pixel of each row and column, and the mask is interpolated between these. See docs/adr/0033-mask-scale.md.

// What the light's technique allows: those that fill the mask by passes of their own do so for all pixels. In masks of
// more than 30 million pixels all are computed, too.
int mask_scale(const Technique& technique, const ParamSet& params, const gl::Texture& mask);

// The receivers at these pixels, as if they were the caller's: textures that are targets of the device and begin with
// `prefix`, and the matrices of a view that has just these pixels. Normals that are made from depths are those that
// were made for the whole view.
struct ScaledInputs {
  Inputs inputs;
  glm::vec2 ndc{1};  // extent of the whole view in it, over that of the caller's
};
ScaledInputs scaled_inputs(const LightWork& work, const std::string& prefix, int scale);

// A mask for every scale-th pixel, and these pixels' depths.
struct ScaledMask {
  const gl::Texture& mask;
  unsigned depth = 0;
};

// Fills the light's layer of the mask from that layer of a scaled mask: all of it, or, where the tiles are decided and
// fill_decided_tiles() has filled its part, the others. Pixels that the four around them can't stand for are left to
// the technique's visibility(), and then to a filter, as listed_pixels() says.
void upsample(const LightWork& work, const ScaledMask& scaled, int scale);

gl::ProgramDesc scaled_receivers_program();

}  // namespace penumbra::shadow
