#pragma once

#include <string_view>

#include "core/params.h"

namespace penumbra::truth {

// Whether a technique is a reference, against which others are measured.
bool is_reference(std::string_view technique);

// Changes parameters so that their technique serves as a reference: without denoiser, history and filters, and, where
// it samples, with another seed, so that its errors are independent of those of the technique that is compared with it.
void make_reference(ParamSet& params);

}  // namespace penumbra::truth
