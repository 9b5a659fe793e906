#pragma once

#include <array>
#include <cstdint>

namespace penumbra::metrics {

// The colour of an error from 0 to 1, 8-bit sRGB: black, violet, red, orange, pale yellow. Errors outside the range are
// clamped; NaN has the colour of 1. Equal steps of the error are equal steps of lightness (CIELAB's L*, 0 to 96), so
// the map also reads in grey, and a change of hue does not look like an edge. Hues rise from 290° to 110° (through
// 360°) in OKLab (Björn Ottosson, "A perceptual color space for image processing", 2020).
std::array<std::uint8_t, 3> heat_color(float error);

}  // namespace penumbra::metrics
