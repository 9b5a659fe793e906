#pragma once

#include <span>
#include <vector>

#include "../core/params.h"
#include "denoiser.h"
#include "filter.h"

namespace penumbra::shadow {

// The rows that belong to no technique, denoiser or filter: driver, sun, cascades, bias, sampling.
std::vector<Param> library_params();
// Which denoiser is used.
Param denoiser_param(std::span<const Denoiser> denoisers);
// Of the movement map, which denoisers ask for.
std::vector<Param> movement_params();
// Which filters are used, and what all of them have.
std::vector<Param> filter_params(std::span<const Filter> filters);

}  // namespace penumbra::shadow
