#pragma once

#include <string>
#include <vector>

#include "pass_context.h"

namespace penumbra::shadow {

// Makes a recipe's pyramid over a layered map, with the programs of edge_pyramid_programs(). RG32F; texel (x, y) of
// level l holds the least of both values over the 4·2^l texels squared from (x, y)·4·2^l on.
const gl::Texture& build_edge_pyramid(const PassContext& context);

// `base`: the compute shader that makes the two finest levels.
std::vector<gl::ProgramDesc> edge_pyramid_programs(const char* base);

}  // namespace penumbra::shadow
