#pragma once

#include <vector>

#include "../core/params.h"

namespace penumbra::shadow {

// The rows that belong to no technique: sun, cascades, bias, sampling, driver.
std::vector<Param> library_params();

}  // namespace penumbra::shadow
