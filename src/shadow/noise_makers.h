#pragma once

#include <cstdint>
#include <vector>

#include "noise.h"

namespace penumbra::shadow {

// Swaps the tile's pixels until neighbours differ.
void anneal(NoiseTile& tile, std::uint64_t seed, int threads, const NoiseProgress& progress);

// Ranks of one channel, row by row.
std::vector<std::uint16_t> void_and_cluster(int size, std::uint64_t seed);

}  // namespace penumbra::shadow
