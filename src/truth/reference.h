#pragma once

#include <string_view>

#include "core/params.h"

namespace penumbra::truth {

// Whether a technique is there to measure others against.
bool is_reference(std::string_view technique);

// Values with which the technique that they select is a reference: nothing that approximates, and, where it samples,
// other noise than the same technique has as a contender.
void make_reference(ParamSet& params);

}  // namespace penumbra::truth
