#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace penumbra::metrics {

// The colour's full scale for errors up to `largest`: the next of 0.001, 0.002, 0.005, 0.01 … 100000.
float heat_scale(float largest);

// Errors as colours (metrics/heat_color.h), 8-bit RGB, over a strip of `heat_legend_rows` that shows the colours from 0
// to `scale` and, where there is room, both numbers.
constexpr int heat_legend_rows = 16;
std::vector<std::uint8_t> heat_map(std::span<const float> errors, int width, int height, float scale);

}  // namespace penumbra::metrics
