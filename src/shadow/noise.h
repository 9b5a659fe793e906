#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace penumbra::shadow {

// A square, tileable noise texture with one to three values a pixel. Each channel contains each of the ranks 0 to size²
// - 1 exactly once, so its histogram is uniform.
struct NoiseTile {
  int size = 0;                      // pixels a side
  int channels = 0;                  // values a pixel
  std::vector<std::uint16_t> ranks;  // row by row, `channels` to a pixel

  int count() const { return size * size; }
  std::uint16_t& rank(int pixel, int channel) { return ranks[static_cast<std::size_t>(pixel * channels + channel)]; }
  std::uint16_t rank(int pixel, int channel) const {
    return ranks[static_cast<std::size_t>(pixel * channels + channel)];
  }
  // In (0, 1).
  float value(int pixel, int channel) const {
    return (static_cast<float>(rank(pixel, channel)) + 0.5f) / static_cast<float>(count());
  }
};

constexpr int least_noise_size = 16;
constexpr int largest_noise_size = 256;
constexpr int most_noise_channels = 3;

// The kinds of noise: white, blue, void_and_cluster, interleaved_gradient.
const std::vector<std::string>& noise_kinds();

// Progress callback; receives the fraction done, 0 to 1. It must not throw, because other threads wait for the thread
// that calls it.
using NoiseProgress = std::function<void(double)>;

// Noise of that kind: the same for the same arguments, whatever the machine and the number of threads (0: one per
// core). The size is a multiple of 16 from 16 to 256. Throws Error on another size, kind or number of channels.
// - white: a random permutation of the ranks.
// - blue: neighbours differ in all channels together (Georgiev and Fajardo 2016, "Blue-noise dithered sampling"), by
//   swaps under simulated annealing.
// - void_and_cluster: each channel separately (Ulichney 1993, "The void-and-cluster method for dither array
//   generation").
// - interleaved_gradient: each channel separately; any 3 × 3 pixels have nearly the same mean, but at the tile's edges,
//   where it does not continue (Jimenez 2014, "Next generation post processing in Call of Duty: Advanced Warfare").
NoiseTile make_noise(std::string_view kind, int size, int channels, std::uint64_t seed, int threads = 0,
                     const NoiseProgress& progress = {});

// The precomputed tile of 64 × 64 pixels with two channels that is embedded in the library; it equals make_noise(kind,
// 64, 2, 1).
NoiseTile built_in_noise(std::string_view kind);

// Ratio of one channel's mean spectral power below 1/8 cycle a pixel to that from 0.35 to 0.5. It is 1 for white noise.
double low_to_high_power(const NoiseTile& tile, int channel);

}  // namespace penumbra::shadow
