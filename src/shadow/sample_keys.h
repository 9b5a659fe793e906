#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "noise.h"

namespace penumbra::shadow {

// Sample points that differ from pixel to pixel by keys, such that the errors of neighbouring pixels differ: blue noise
// (Heitz et al. 2019, "A low-discrepancy sampler that distributes Monte Carlo errors as a blue noise in screen
// space"). All pixels use the same 256 points: Sobol's first two dimensions (Sobol' 1967) with nested uniform
// scrambling (Owen 1995), of which the first 2^k, and each 2^k from a multiple of it on, have one in each elementary
// interval of area 2^-k.
struct SampleKey {
  // Flips digits of the points' coordinates; which keeps their elementary intervals.
  std::uint8_t x = 0, y = 0;
  // Changes the order: sample number k is point k XOR order.
  std::uint8_t order = 0;

  bool operator==(const SampleKey&) const = default;
};

constexpr int keyed_point_count = 256;
// The numbers of samples at which keys are optimised together; below the least, each power of two is.
constexpr std::array<int, 4> optimised_counts{8, 16, 32, 64};

// The points, each coordinate a multiple of 1/256 times 256: 0 to 255.
const std::array<glm::u8vec2, keyed_point_count>& keyed_points();

// Sample `index` of 0 to 255 of a pixel with that key, in the unit square: in the middle of one of 256 × 256 cells.
glm::vec2 keyed_point(const SampleKey& key, int index);

// A square, tileable texture of keys, row by row.
struct KeyTile {
  int size = 0;  // pixels a side
  std::vector<SampleKey> keys;

  bool operator==(const KeyTile&) const = default;
};

// Keys of size² pixels, size a multiple of 16 from 16 to 256, by swaps under simulated annealing; the same for the same
// arguments on every machine. Throws Error on another size.
KeyTile make_sample_keys(int size, std::uint64_t seed, const NoiseProgress& progress = {});

// The embedded tile of 64 × 64 pixels: make_sample_keys(64, 1).
KeyTile built_in_sample_keys();

// For each pixel: the share of its first `count` samples in the half-plane x · direction > offset of the disc onto
// which square points are mapped, −1 to 1, minus that of all cells.
std::vector<double> key_errors(const KeyTile& tile, int count, glm::vec2 direction, float offset);

}  // namespace penumbra::shadow
