#pragma once

#include <span>
#include <vector>

#include "../core/params.h"
#include "technique.h"

namespace penumbra::shadow {

// The rows that belong to no technique: sun, cascades, bias, sampling, history, filters, driver.
std::vector<Param> library_params(std::span<const Filter> filters);

// Of half the angle that the sun spans.
float tan_half_angle(const ParamSet& params);

}  // namespace penumbra::shadow
