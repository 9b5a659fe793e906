#pragma once

#include "registry.h"

namespace penumbra::shadow {

// Throws Error for the faults that Registry's constructor lists.
void check_contents(const Registry& registry);

}  // namespace penumbra::shadow
