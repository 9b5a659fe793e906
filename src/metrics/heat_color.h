#pragma once

#include <array>
#include <cstdint>

namespace penumbra::metrics {

// The colour of an error from 0 to 1, 8-bit sRGB: black, violet, red, orange, pale yellow. Others are clamped; NaN is
// the colour of 1. Equal steps of the error are equal steps of lightness (CIELAB's L*, 0 to 96), so it can also be
// read in grey, and a change of hue does not look like an edge. Hues go from 290° up to 110° in OKLab (Björn Ottosson,
// "A perceptual color space for image processing", 2020).
std::array<std::uint8_t, 3> heat_color(float error);

}  // namespace penumbra::metrics
