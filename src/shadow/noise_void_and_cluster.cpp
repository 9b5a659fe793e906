#include <algorithm>
#include <cmath>

#include "../core/random.h"
#include "noise_makers.h"

namespace penumbra::shadow {

namespace {

// A tileable binary image, and at each pixel the sum of Gaussians centred at the pixels that are set. Sums are
// integers, so they don't depend on the order of summation.
class Clusters {
 public:
  explicit Clusters(int size) : size_(size), set_(pixels(), 0), energy_(pixels(), 0), gaussian_(pixels()) {
    constexpr double sigma = 1.9;
    for (int pixel = 0; pixel < size * size; ++pixel) {
      const int dx = std::min(pixel % size, size - pixel % size);
      const int dy = std::min(pixel / size, size - pixel / size);
      const double weight = std::exp(-(dx * dx + dy * dy) / (2 * sigma * sigma));
      gaussian_[static_cast<std::size_t>(pixel)] = std::llround(weight * 1099511627776.0);
    }
  }

  bool is_set(std::size_t pixel) const { return set_[pixel] != 0; }

  void put(std::size_t pixel, bool set) {
    set_[pixel] = set ? 1 : 0;
    const auto size = static_cast<std::size_t>(size_);
    const std::size_t px = pixel % size;
    const std::size_t py = pixel / size;
    for (std::size_t y = 0; y < size; ++y) {
      const std::size_t row = (y + size - py) % size * size;
      for (std::size_t x = 0; x < size; ++x) {
        const std::int64_t weight = gaussian_[row + (x + size - px) % size];
        energy_[y * size + x] += set ? weight : -weight;
      }
    }
  }

  // The set pixel in the tightest cluster (largest sum), or the unset one in the largest void (smallest sum).
  std::size_t tightest_cluster() const {
    return extreme(1, [](auto a, auto b) { return a > b; });
  }
  std::size_t largest_void() const {
    return extreme(0, [](auto a, auto b) { return a < b; });
  }

 private:
  std::size_t pixels() const { return static_cast<std::size_t>(size_) * static_cast<std::size_t>(size_); }

  template <class Better>
  std::size_t extreme(int among, Better better) const {
    std::size_t best = set_.size();
    for (std::size_t pixel = 0; pixel < set_.size(); ++pixel) {
      if (set_[pixel] == among && (best == set_.size() || better(energy_[pixel], energy_[best]))) best = pixel;
    }
    return best;
  }

  int size_;
  std::vector<char> set_;
  std::vector<std::int64_t> energy_;
  std::vector<std::int64_t> gaussian_;
};

// A tenth of the pixels set at random, then moved one by one from the tightest cluster to the largest void, until a
// move would put the pixel back.
Clusters prototype(int size, std::uint64_t seed) {
  Clusters clusters(size);
  Random random(seed);
  const auto pixels = static_cast<std::uint32_t>(size * size);
  for (std::uint32_t ones = 0; ones < pixels / 10;) {
    const std::size_t pixel = random.below(pixels);
    if (clusters.is_set(pixel)) continue;
    clusters.put(pixel, true);
    ++ones;
  }
  for (;;) {
    const std::size_t from = clusters.tightest_cluster();
    clusters.put(from, false);
    const std::size_t to = clusters.largest_void();
    clusters.put(to, true);
    if (to == from) return clusters;
  }
}

}  // namespace

std::vector<std::uint16_t> void_and_cluster(int size, std::uint64_t seed) {
  const Clusters start = prototype(size, seed);
  const int count = size * size;
  const int ones = count / 10;
  std::vector<std::uint16_t> ranks(static_cast<std::size_t>(count));
  Clusters clusters = start;
  for (int rank = ones - 1; rank >= 0; --rank) {
    const std::size_t pixel = clusters.tightest_cluster();
    clusters.put(pixel, false);
    ranks[pixel] = static_cast<std::uint16_t>(rank);
  }
  clusters = start;
  for (int rank = ones; rank < count; ++rank) {
    const std::size_t pixel = clusters.largest_void();
    clusters.put(pixel, true);
    ranks[pixel] = static_cast<std::uint16_t>(rank);
  }
  return ranks;
}

}  // namespace penumbra::shadow
