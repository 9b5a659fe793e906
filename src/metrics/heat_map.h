#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace penumbra::metrics {

// The error at the top of the colour scale for errors up to `largest`: the next of 0.001, 0.002, 0.005, 0.01 … 100000.
float heat_scale(float largest);

// The least and the most that the legend has figures for: it can't write an exponent.
constexpr double least_heat_scale = 0.0001, most_heat_scale = 100'000;

// Errors as colours (metrics/heat_color.h), 8-bit RGB, above a legend of `heat_legend_rows` rows: the colours from 0 to
// `scale`, within these limits, and, where there is room, both numbers.
constexpr int heat_legend_rows = 16;
std::vector<std::uint8_t> heat_map(std::span<const float> errors, int width, int height, float scale);

}  // namespace penumbra::metrics
