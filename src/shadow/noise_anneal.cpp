#include <algorithm>
#include <array>
#include <atomic>
#include <barrier>
#include <cmath>
#include <exception>
#include <functional>
#include <thread>

#include "../core/random.h"
#include "noise_makers.h"

// Minimises Georgiev and Fajardo's energy, the sum over all pairs of pixels of
//   exp(-|pᵢ - qᵢ|²/σᵢ² - |pₛ - qₛ|^(d/2)/σₛ²)
// with distances of pixels on the torus and of their d values, σᵢ = 2.1 and σₛ = 1. The tile is cut into blocks of 8 ×
// 8 pixels. Blocks of the same parity are further apart than the Gaussian's radius, so threads can swap pixels within
// different blocks in parallel, and the result doesn't depend on the number of threads. The block boundaries move from
// turn to turn.
namespace penumbra::shadow {

namespace {

constexpr int kernel_radius = 7;  // pixels: farther ones weigh under 2e-5
constexpr int block_side = 8;     // over `kernel_radius`
constexpr int turns = 1600;       // of all four parities
constexpr double coldest = 1e-3;

// Energies are sums of integers from tables, so that they don't depend on the order of summation, nor swaps on how a
// platform rounds exp(). Only the distance of two values is a float; its squares are added in a fixed order, and it is
// truncated to an integer.
class Energy {
 public:
  explicit Energy(const NoiseTile& tile) : tile_(tile) {
    for (int dy = -kernel_radius; dy <= kernel_radius; ++dy) {
      for (int dx = -kernel_radius; dx <= kernel_radius; ++dx) {
        if (dx == 0 && dy == 0) continue;
        neighbours_.push_back({dx, dy, std::lround(32768 * std::exp(-(dx * dx + dy * dy) / (2.1 * 2.1)))});
      }
    }
    for (int i = -kernel_radius; i < tile.size + kernel_radius; ++i) wrapped_.push_back((i + tile.size) % tile.size);
    const auto longest = static_cast<int>(std::ceil(tile.count() * std::sqrt(tile.channels)));
    for (int i = 0; i <= longest; ++i) {
      const double distance = static_cast<double>(i) / tile.count();
      similarity_.push_back(std::lround(32768 * std::exp(-std::pow(distance, 0.5 * tile.channels))));
    }
  }

  // Change of energy from swapping the values of two pixels.
  std::int64_t of_swap(int a, int b) const {
    const auto value_a = values(a);
    const auto value_b = values(b);
    return about(a, b, value_b) - about(a, b, value_a) + about(b, a, value_a) - about(b, a, value_b);
  }

 private:
  struct Neighbour {
    int dx, dy;
    std::int64_t weight;
  };
  using Values = std::array<int, most_noise_channels>;

  Values values(int pixel) const {
    Values values{};
    for (int c = 0; c < tile_.channels; ++c) values[static_cast<std::size_t>(c)] = tile_.rank(pixel, c);
    return values;
  }

  // Energy between `pixel` and its neighbours except `other`, if `pixel` had those values.
  std::int64_t about(int pixel, int other, const Values& values) const {
    const int size = tile_.size;
    const int* column = &wrapped_[static_cast<std::size_t>(pixel % size + kernel_radius)];
    const int* row = &wrapped_[static_cast<std::size_t>(pixel / size + kernel_radius)];
    std::int64_t sum = 0;
    for (const Neighbour& n : neighbours_) {
      const int neighbour = row[n.dy] * size + column[n.dx];
      if (neighbour == other) continue;
      float square = 0;
      for (int c = 0; c < tile_.channels; ++c) {
        const auto difference = static_cast<float>(values[static_cast<std::size_t>(c)] - tile_.rank(neighbour, c));
        square += difference * difference;
      }
      sum += n.weight * similarity_[static_cast<std::size_t>(std::sqrt(square))];
    }
    return sum;
  }

  const NoiseTile& tile_;
  std::vector<Neighbour> neighbours_;
  std::vector<int> wrapped_;              // coordinates from -kernel_radius on, on the torus
  std::vector<std::int64_t> similarity_;  // by distance of values, in ranks
};

// A turn's block boundaries and annealing temperature.
struct Turn {
  int shift_x = 0, shift_y = 0;
  double temperature = 0;
};

class Annealer {
 public:
  Annealer(NoiseTile& tile, std::uint64_t seed) : tile_(tile), seed_(seed), energy_(tile), random_(seed) {
    for (std::size_t i = 0; i < hotness_.size(); ++i) {
      hotness_[i] = -std::log((static_cast<double>(i) + 0.5) / static_cast<double>(hotness_.size()));
    }
    hottest_ = 0.25 * mean_change();
  }

  void begin_turn(int turn) {
    const double progress = static_cast<double>(turn) / (turns - 1);
    turn_.temperature = hottest_ * std::pow(coldest, progress);
    turn_.shift_x = static_cast<int>(random_.below(static_cast<std::uint32_t>(tile_.size)));
    turn_.shift_y = static_cast<int>(random_.below(static_cast<std::uint32_t>(tile_.size)));
    number_ = turn;
  }

  // Processes one worker's part of the blocks of one parity.
  void swap_in_blocks(int parity, int worker, int workers) {
    const int across = tile_.size / (2 * block_side);
    for (int i = worker; i < across * across; i += workers) {
      const int x = (2 * (i % across) + parity % 2) * block_side + turn_.shift_x;
      const int y = (2 * (i / across) + parity / 2) * block_side + turn_.shift_y;
      const auto visit = static_cast<std::uint64_t>((number_ * 4 + parity) * across * across + i);
      swap_in_block(x, y, Random((seed_ << 40U) ^ visit));
    }
  }

 private:
  double mean_change() {
    double sum = 0;
    constexpr int tries = 1000;
    const auto pixels = static_cast<std::uint32_t>(tile_.count());
    for (int i = 0; i < tries; ++i) {
      const auto a = static_cast<int>(random_.below(pixels));
      const auto b = static_cast<int>(random_.below(pixels));
      if (a != b) sum += std::abs(static_cast<double>(energy_.of_swap(a, b)));
    }
    return sum / tries;
  }

  int pixel_in_block(int x, int y, std::uint32_t index) const {
    const int px = (x + static_cast<int>(index) % block_side) % tile_.size;
    const int py = (y + static_cast<int>(index) / block_side) % tile_.size;
    return py * tile_.size + px;
  }

  void swap_in_block(int x, int y, Random random) {
    constexpr std::uint32_t pixels = block_side * block_side;
    for (std::uint32_t i = 0; i < pixels; ++i) {
      const int a = pixel_in_block(x, y, random.below(pixels));
      const int b = pixel_in_block(x, y, random.below(pixels));
      const double allowed = turn_.temperature * hotness_[random.below(hotness_.size())];
      if (a == b || static_cast<double>(energy_.of_swap(a, b)) > allowed) continue;
      for (int c = 0; c < tile_.channels; ++c) std::swap(tile_.rank(a, c), tile_.rank(b, c));
    }
  }

  NoiseTile& tile_;
  std::uint64_t seed_;
  Energy energy_;
  Random random_;
  std::array<double, 4096> hotness_{};  // -log of a uniform random number
  double hottest_ = 0;
  Turn turn_;
  int number_ = 0;
};

}  // namespace

void anneal(NoiseTile& tile, std::uint64_t seed, int threads, const NoiseProgress& progress) {
  Annealer annealer(tile, seed);
  const int blocks = tile.size * tile.size / (4 * block_side * block_side);
  const int cores = threads > 0 ? threads : static_cast<int>(std::thread::hardware_concurrency());
  const int workers = std::clamp(cores, 1, blocks);
  // A barrier after each parity; after the last parity the next turn begins.
  int phase = 0;
  annealer.begin_turn(0);
  std::barrier turn_over(workers, [&]() noexcept {
    if (++phase % 4 == 0 && phase < 4 * turns) annealer.begin_turn(phase / 4);
  });
  std::atomic<bool> stopped = false;
  const auto work = [&](int first, int last, const std::function<void(int)>& turned) {
    for (int turn = 0; turn < turns && !stopped; ++turn) {
      for (int parity = 0; parity < 4; ++parity) {
        for (int worker = first; worker < last; ++worker) annealer.swap_in_blocks(parity, worker, workers);
        turn_over.arrive_and_wait();
      }
      turned(turn);
    }
    if (stopped) turn_over.arrive_and_drop();
  };
  std::vector<std::jthread> helpers;
  int first_own = workers - 1;  // this thread works as this one and all after it
  try {
    for (int worker = 0; worker < first_own; ++worker)
      helpers.emplace_back([&, worker] { work(worker, worker + 1, [](int) {}); });
  } catch (const std::exception&) {
    // The system refuses another thread, or memory for it.
    first_own = static_cast<int>(helpers.size());
    for (int missing = first_own + 1; missing < workers; ++missing) turn_over.arrive_and_drop();
  }
  try {
    work(first_own, workers, [&](int turn) { progress((turn + 1.0) / turns); });
  } catch (...) {
    stopped = true;
    turn_over.arrive_and_drop();
    throw;
  }
}

}  // namespace penumbra::shadow
