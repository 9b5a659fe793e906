#pragma once

#include <span>
#include <vector>

#include "library_frame.h"

namespace penumbra::shadow {

// The penumbra filter of the parameters over packed texels: R32UI, the size of the mask. `source` itself if it is
// "none".
const gl::Texture& filter_penumbra(const LibraryFrame& work, const Registry& registry, const gl::Texture& source);

// Fills the mask's layer (see Mask) from packed texels, by the visibility filter of the parameters, or as they are if
// it is "none".
void filter_visibility(const LibraryFrame& work, const Registry& registry, const PackedMask& packed);

// All programs of these filters, under both drivers, and that which only unpacks.
std::vector<LibraryProgram> filter_programs(std::span<const Filter> filters);

}  // namespace penumbra::shadow
