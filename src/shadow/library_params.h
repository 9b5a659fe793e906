#pragma once

#include <span>
#include <vector>

#include "../core/params.h"
#include "denoiser.h"
#include "filter.h"

namespace penumbra::shadow {

// The parameters that belong to no technique, denoiser or filter: driver, sun, cascades, bias, sampling.
std::vector<Param> library_params();
// The parameter that chooses the denoiser.
Param denoiser_param(std::span<const Denoiser> denoisers);
// The parameters of the movement map, which denoisers with a history use.
std::vector<Param> movement_params();
// The parameters that choose the filters, and those that all filters share.
std::vector<Param> filter_params(std::span<const Filter> filters);

}  // namespace penumbra::shadow
