#pragma once

#include <string>
#include <string_view>

#include "core/params.h"

namespace penumbra::truth {

// Whether a technique is a reference, against which others are measured.
bool is_reference(std::string_view technique);

// Whether a parameter says what the light is or which casters count. Whatever is compared with a reference has the same
// values of these.
bool is_of_scene(std::string_view param);

// Changes parameters so that their technique serves as a reference: without denoiser, history and filters, for all
// pixels, and, where it samples, with another seed, so that its errors are independent of those of the technique that
// is compared with it.
void make_reference(ParamSet& params);

// How many rays the technique `truth` traces with these parameters, in words: "104 rays a pixel".
std::string rays_text(const ParamSet& params);

}  // namespace penumbra::truth
