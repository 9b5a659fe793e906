#pragma once

#include <vector>

#include "library_frame.h"

namespace penumbra::shadow {

// Whether the parameters ask for more than a technique's own visibility: a history or a filter.
bool is_denoised(const ParamSet& params);

// Fills the mask's layer: the technique's visibility as packed texels, its penumbrae filtered, blended with the last
// frames, and filtered (Deligiannis 2019, section 3.5). What is kept for the next frame is not yet filtered, so that no
// blur comes on top of another. Returns the notes on each pixel (see LightFrame).
const gl::Texture& draw_denoised(const LibraryFrame& work, const Registry& registry);

// Programs of the library's own passes here.
std::vector<LibraryProgram> denoise_programs(const Registry& registry);

}  // namespace penumbra::shadow
