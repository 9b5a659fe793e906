#pragma once

#include <array>
#include <cstdint>

#include "noise.h"

namespace penumbra::shadow {

// The embedded tiles' ranks: 64 × 64 pixels of two channels; spatiotemporal: of each frame.
inline constexpr std::size_t built_in_noise_values = 2UL * built_in_noise_side * built_in_noise_side;
extern const std::array<std::uint16_t, built_in_noise_values> blue_tile;
extern const std::array<std::uint16_t, built_in_noise_values> void_and_cluster_tile;
extern const std::array<std::uint16_t, spatiotemporal_frames * built_in_noise_values> spatiotemporal_tile;
// Three numbers a pixel: see KeyTile.
extern const std::array<std::uint16_t, 3UL * built_in_noise_side * built_in_noise_side> sample_keys_tile;

}  // namespace penumbra::shadow
