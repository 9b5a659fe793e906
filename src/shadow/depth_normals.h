#pragma once

#include "light_work.h"

namespace penumbra::shadow {

// For callers that bring no normals, or those of shading, makes ViewState::normals once a frame: RGBA32F, the normal of
// the plane through each pixel of the viewport and its neighbours, in the octahedral map, and the distances of the
// points that it was made from. See Inputs::normals. In a pass of its own, that reads the light's uniform blocks; the
// result is the same for all lights of a view.
void make_normals(const LightWork& work, ViewState& view);

// Releases that texture, if there is one.
void drop_normals(gl::Device& device, ViewState& view);

// `guided`: by normals of shading.
LibraryProgram depth_normals_program(bool guided);

}  // namespace penumbra::shadow
