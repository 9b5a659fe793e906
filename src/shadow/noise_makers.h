#pragma once

#include <cstdint>
#include <vector>

#include "noise.h"

namespace penumbra::shadow {

// Swaps pixels of the tile by simulated annealing until neighbouring values differ (blue noise; see noise.h).
void anneal(NoiseTile& tile, std::uint64_t seed, int threads, const NoiseProgress& progress);

// The ranks of one channel, row by row and frame by frame, made by the void-and-cluster method.
std::vector<std::uint16_t> void_and_cluster(int size, int frames, std::uint64_t seed, const NoiseProgress& progress);

}  // namespace penumbra::shadow
