#pragma once

#include <span>
#include <vector>

#include "../core/params.h"
#include "technique.h"

namespace penumbra::shadow {

// The rows that belong to no technique: sun, cascades, bias, sampling, history, filters, driver.
std::vector<Param> library_params(std::span<const Filter> filters);

}  // namespace penumbra::shadow
