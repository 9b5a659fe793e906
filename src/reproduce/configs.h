#pragma once

#include <string>

#include "reproduce/crops.h"

namespace penumbra::reproduce {

// Taps of the blocker search and of the filter.
struct Taps {
  int blocker = 16, filter = 8;
};
constexpr Taps few_taps{16, 8}, some_taps{32, 32}, many_taps{64, 64};  // of figures 4.2 to 4.9

// PCSS as in section 4.1 of the thesis: both steps use the same pattern, which the noise offsets on the torus from
// pixel to pixel; no history and no filter. Its name is "poisson 16×8 with white noise".
NamedConfig sampled(const std::string& noise, const std::string& pattern, const Taps& taps);

// The same through a visibility filter, "bilateral_separable" or "gaussian", of "a fixed kernel size" (chapter 4 of the
// thesis): wherever the penumbra is wide its standard deviation is a ninetieth of the picture's height, in pixels.
NamedConfig denoised(const Workbench& bench, const NamedConfig& noisy, const std::string& filter);
double fixed_sigma(const Workbench& bench);

}  // namespace penumbra::reproduce
