#pragma once

#include <array>
#include <cstdint>

namespace penumbra::shadow {

// The embedded tiles' ranks: 64 × 64 pixels of two channels.
inline constexpr int built_in_noise_size = 64;
inline constexpr std::size_t built_in_noise_values = 2UL * built_in_noise_size * built_in_noise_size;
extern const std::array<std::uint16_t, built_in_noise_values> blue_ranks;
extern const std::array<std::uint16_t, built_in_noise_values> void_and_cluster_ranks;

}  // namespace penumbra::shadow
