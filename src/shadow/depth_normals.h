#pragma once

#include "light_work.h"

namespace penumbra::shadow {

// For callers that bring no normals, or those of shading: RGBA32F, the normal of the plane through each pixel of the
// viewport and its neighbours, in the octahedral map, and the distances of the points that it was made from. See
// Inputs::normals. In a pass of its own, that reads the light's uniform blocks; the result is the same for all lights
// of a view.
const gl::Texture& make_normals(const LightWork& work);

// Releases that texture.
void drop_normals(gl::Device& device, const ViewState& view);

// `guided`: by normals of shading.
LibraryProgram depth_normals_program(bool guided);

}  // namespace penumbra::shadow
