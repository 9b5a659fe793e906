#pragma once

#include <map>

#include "mask_scale.h"

namespace penumbra::shadow {

// The receivers of masks of fewer pixels that the view's lights have asked for in a frame, by scale.
using ScaledViews = std::map<int, ScaledInputs>;

// Fills the light's layer of the mask: runs the technique and the denoiser, for all pixels or for those that
// mask.scale leaves.
void draw_layer(const LightWork& work, ScaledViews& views);

// Releases what belongs to scales that no light of the frame has used.
void release_scales(gl::Device& device, const ViewState& view, const ScaledViews& used);

}  // namespace penumbra::shadow
