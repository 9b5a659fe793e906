#include "noise.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>

#include "../core/error.h"
#include "../core/names.h"
#include "../core/random.h"
#include "noise_makers.h"
#include "noise_tiles.h"

namespace penumbra::shadow {

namespace {

std::uint64_t channel_seed(std::uint64_t seed, int channel) {
  return seed * most_noise_channels + static_cast<std::uint64_t>(channel);
}

void set_channel(NoiseTile& tile, int channel, const std::vector<std::uint16_t>& ranks) {
  for (int pixel = 0; pixel < tile.count(); ++pixel) tile.rank(pixel, channel) = ranks[static_cast<std::size_t>(pixel)];
}

std::vector<std::uint16_t> shuffled(int count, std::uint64_t seed) {
  std::vector<std::uint16_t> ranks(static_cast<std::size_t>(count));
  std::iota(ranks.begin(), ranks.end(), std::uint16_t{0});
  Random random(seed);
  for (auto i = static_cast<std::uint32_t>(count); i > 1; --i) std::swap(ranks[i - 1], ranks[random.below(i)]);
  return ranks;
}

// fract(52.9829189 · fract(0.06711056 x + 0.00583715 y)), the second channel with x and y swapped, the third mirrored.
// The seed moves the pattern, by an amount that Jimenez proposes for consecutive frames.
double gradient_noise(int pixel, int size, int channel, std::uint64_t seed) {
  const double shift = 5.588238 * static_cast<double>(seed % 64);
  const int column = pixel % size, row = pixel / size;
  const double x = (channel == 2 ? size - 1 - column : column) + shift;
  const double y = row + shift;
  const double phase = channel == 1 ? 0.06711056 * y + 0.00583715 * x : 0.06711056 * x + 0.00583715 * y;
  return std::fmod(52.9829189 * std::fmod(phase, 1), 1);
}

std::vector<std::uint16_t> interleaved_gradient(int size, int channel, std::uint64_t seed) {
  std::vector<int> order(static_cast<std::size_t>(size * size));
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](int pixel) { return gradient_noise(pixel, size, channel, seed); });
  std::vector<std::uint16_t> ranks(order.size());
  for (std::size_t rank = 0; rank < order.size(); ++rank)
    ranks[static_cast<std::size_t>(order[rank])] = static_cast<std::uint16_t>(rank);
  return ranks;
}

NoiseTile white(int size, int channels, int frames, std::uint64_t seed) {
  NoiseTile tile{.size = size, .channels = channels, .frames = frames, .ranks = {}};
  tile.ranks.resize(static_cast<std::size_t>(tile.count() * channels));
  for (int channel = 0; channel < channels; ++channel) {
    set_channel(tile, channel, shuffled(tile.count(), channel_seed(seed, channel)));
  }
  return tile;
}

void check(std::string_view kind, int size, int channels) {
  if (size < least_noise_size || size > largest_noise_size || size % least_noise_size != 0) {
    fail("noise of {0} × {0} pixels: the side is a multiple of {1} from {1} to {2}", size, least_noise_size,
         largest_noise_size);
  }
  if (kind == "spatiotemporal" && size > largest_spatiotemporal_size) {
    fail("spatiotemporal noise of {0} × {0} pixels: it can have {1} × {1}", size, largest_spatiotemporal_size);
  }
  if (channels < 1 || channels > most_noise_channels) {
    fail("noise of {} channels: there can be 1 to {}", channels, most_noise_channels);
  }
}

using Row = std::vector<std::complex<double>>;

// Discrete Fourier transform of `size` values, `stride` apart.
void transform(std::complex<double>* values, int size, int stride) {
  Row result(static_cast<std::size_t>(size));
  for (int k = 0; k < size; ++k) {
    for (int x = 0; x < size; ++x) {
      result[static_cast<std::size_t>(k)] +=
          values[x * stride] * std::polar(1.0, -2 * std::numbers::pi * (k * x % size) / size);
    }
  }
  for (int k = 0; k < size; ++k) values[k * stride] = result[static_cast<std::size_t>(k)];
}

}  // namespace

const std::vector<std::string>& noise_kinds() {
  static const std::vector<std::string> kinds{"white", "blue", "void_and_cluster", "interleaved_gradient",
                                              "spatiotemporal"};
  return kinds;
}

NoiseTile make_noise(std::string_view kind, int size, int channels, std::uint64_t seed, int threads,
                     const NoiseProgress& progress) {
  check(kind, size, channels);
  const auto report = [&](double done) {
    if (progress) progress(done);
  };
  const int frames = kind == "spatiotemporal" ? spatiotemporal_frames : 1;
  NoiseTile tile = white(size, channels, frames, seed);
  if (kind == "blue") {
    anneal(tile, seed, threads, report);
  } else if (kind == "void_and_cluster" || kind == "spatiotemporal") {
    for (int channel = 0; channel < channels; ++channel) {
      set_channel(tile, channel, void_and_cluster(size, frames, channel_seed(seed, channel), [&](double done) {
                    report((channel + done) / channels);
                  }));
    }
  } else if (kind == "interleaved_gradient") {
    for (int channel = 0; channel < channels; ++channel) {
      set_channel(tile, channel, interleaved_gradient(size, channel, seed));
    }
  } else if (kind != "white") {
    fail_unknown("noise", kind, noise_kinds());
  }
  return tile;
}

NoiseTile built_in_noise(std::string_view kind) {
  const auto tile = [](const auto& ranks) {
    const auto frames = static_cast<int>(ranks.size() / built_in_noise_values);
    return NoiseTile{built_in_noise_side, 2, frames, std::vector<std::uint16_t>(ranks.begin(), ranks.end())};
  };
  if (kind == "blue") return tile(blue_tile);
  if (kind == "void_and_cluster") return tile(void_and_cluster_tile);
  if (kind == "spatiotemporal") return tile(spatiotemporal_tile);
  return make_noise(kind, built_in_noise_side, 2, 1);
}

double low_to_high_power(const std::vector<double>& picture, int size) {
  Row field(picture.begin(), picture.end());
  for (int row = 0; row < size; ++row) transform(&field[static_cast<std::size_t>(row * size)], size, 1);
  for (int column = 0; column < size; ++column) transform(&field[static_cast<std::size_t>(column)], size, size);
  double low = 0;
  double high = 0;
  int lows = 0;
  int highs = 0;
  for (int pixel = 1; pixel < size * size; ++pixel) {
    const int u = pixel % size;
    const int v = pixel / size;
    const double frequency = std::hypot(std::min(u, size - u), std::min(v, size - v)) / size;
    const double power = std::norm(field[static_cast<std::size_t>(pixel)]);
    if (frequency < 0.125) {
      low += power;
      ++lows;
    } else if (frequency > 0.35 && frequency <= 0.5) {
      high += power;
      ++highs;
    }
  }
  return (low / lows) / (high / highs);
}

double low_to_high_power(const NoiseTile& tile, int channel) {
  const int pixels = tile.size * tile.size;
  double sum = 0;
  for (int frame = 0; frame < tile.frames; ++frame) {
    std::vector<double> picture;
    for (int pixel = 0; pixel < pixels; ++pixel) picture.push_back(tile.value(frame * pixels + pixel, channel) - 0.5);
    sum += low_to_high_power(picture, tile.size);
  }
  return sum / tile.frames;
}

}  // namespace penumbra::shadow
