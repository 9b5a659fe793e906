#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace penumbra::shadow {

// A square, tileable noise texture with one to three values a pixel, or several that follow each other. Each channel
// contains each of the ranks 0 to count() - 1 exactly once, so its histogram is uniform.
struct NoiseTile {
  int size = 0;      // pixels a side
  int channels = 0;  // values a pixel
  int frames = 1;
  std::vector<std::uint16_t> ranks;  // frame by frame, row by row, `channels` to a pixel

  // Pixels of all frames.
  int count() const { return size * size * frames; }
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
constexpr int built_in_noise_side = 64;  // pixels
constexpr int spatiotemporal_frames = 16;
constexpr int largest_spatiotemporal_size = 64;  // whose ranks fill 16 bits

// The kinds of noise: white, blue, void_and_cluster, interleaved_gradient, spatiotemporal.
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
// - spatiotemporal: each channel separately, 16 frames of at most 64 × 64 pixels: blue noise in each frame, and each
//   pixel's values in frames that follow each other too (Wolfe et al. 2022, "Spatiotemporal blue noise masks").
NoiseTile make_noise(std::string_view kind, int size, int channels, std::uint64_t seed, int threads = 0,
                     const NoiseProgress& progress = {});

// The tile of 64 × 64 pixels with two channels that the library uses; it equals make_noise(kind, 64, 2, 1). Those that
// take long to make are embedded in the library.
NoiseTile built_in_noise(std::string_view kind);

// Ratio of one channel's mean spectral power below 1/8 cycle a pixel to that from 0.35 to 0.5, mean of all frames. It
// is 1 for white noise.
double low_to_high_power(const NoiseTile& tile, int channel);
// The same of a square picture of size² values, row by row.
double low_to_high_power(const std::vector<double>& picture, int size);

}  // namespace penumbra::shadow
