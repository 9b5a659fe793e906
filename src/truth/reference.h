#pragma once

#include <string_view>

#include "core/params.h"

namespace penumbra::truth {

// Whether a technique is a reference, that others are measured against.
bool is_reference(std::string_view technique);

// Changes parameters so that their technique is a reference: no history and no filters, and, where it samples, another
// seed, so that its errors are independent of those of the technique it is compared with.
void make_reference(ParamSet& params);

}  // namespace penumbra::truth
