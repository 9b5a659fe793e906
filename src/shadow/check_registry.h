#pragma once

#include "registry.h"

namespace penumbra::shadow {

// Throws Error as Registry's constructor says.
void check_contents(const Registry& registry);

}  // namespace penumbra::shadow
