#include <algorithm>
#include <cmath>

#include "../core/random.h"
#include "noise_makers.h"

namespace penumbra::shadow {

namespace {

// Weight at a distance of `squared`² pixels or frames.
std::int64_t gaussian(int squared) {
  constexpr double sigma = 1.9;
  return std::llround(std::exp(-squared / (2 * sigma * sigma)) * 1099511627776.0);
}

// Distance on a circle of `size`.
int around(int distance, int size) { return std::min(distance, size - distance); }

// Tileable binary images that follow each other, the first one after the last, and at each pixel the sum of Gaussians
// centred at the pixels that are set: those of its frame, and itself in other frames. Sums are integers, so they don't
// depend on the order of summation.
class Clusters {
 public:
  Clusters(int size, int frames) : size_(size), frames_(frames), set_(pixels(), 0), energy_(pixels(), 0) {
    for (int pixel = 0; pixel < size * size; ++pixel) {
      const int dx = around(pixel % size, size), dy = around(pixel / size, size);
      in_frame_.push_back(gaussian(dx * dx + dy * dy));
    }
    for (int frame = 0; frame < frames; ++frame) {
      const int distance = around(frame, frames);
      between_frames_.push_back(gaussian(distance * distance));
    }
  }

  bool is_set(std::size_t pixel) const { return set_[pixel] != 0; }

  void put(std::size_t pixel, bool set) {
    set_[pixel] = set ? 1 : 0;
    const auto size = static_cast<std::size_t>(size_), frames = static_cast<std::size_t>(frames_);
    const std::size_t frame = pixel / (size * size), place = pixel % (size * size);
    const std::size_t px = place % size, py = place / size;
    for (std::size_t y = 0; y < size; ++y) {
      const std::size_t row = (y + size - py) % size * size;
      for (std::size_t x = 0; x < size; ++x) {
        const std::int64_t weight = in_frame_[row + (x + size - px) % size];
        energy_[(frame * size + y) * size + x] += set ? weight : -weight;
      }
    }
    for (std::size_t other = 0; other < frames; ++other) {
      if (other == frame) continue;
      const std::int64_t weight = between_frames_[(other + frames - frame) % frames];
      energy_[other * size * size + place] += set ? weight : -weight;
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
  std::size_t pixels() const { return static_cast<std::size_t>(size_ * size_ * frames_); }

  template <class Better>
  std::size_t extreme(int among, Better better) const {
    std::size_t best = set_.size();
    for (std::size_t pixel = 0; pixel < set_.size(); ++pixel) {
      if (set_[pixel] == among && (best == set_.size() || better(energy_[pixel], energy_[best]))) best = pixel;
    }
    return best;
  }

  int size_, frames_;
  std::vector<char> set_;
  std::vector<std::int64_t> energy_;
  std::vector<std::int64_t> in_frame_;        // by the distance on the torus, row by row
  std::vector<std::int64_t> between_frames_;  // by the distance
};

// A tenth of the pixels set at random, then moved one by one from the tightest cluster to the largest void, until a
// move would put the pixel back.
Clusters prototype(int size, int frames, std::uint64_t seed) {
  Clusters clusters(size, frames);
  Random random(seed);
  const auto pixels = static_cast<std::uint32_t>(size * size * frames);
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

std::vector<std::uint16_t> void_and_cluster(int size, int frames, std::uint64_t seed, const NoiseProgress& progress) {
  const Clusters start = prototype(size, frames, seed);
  const int count = size * size * frames;
  const int ones = count / 10;
  std::vector<std::uint16_t> ranks(static_cast<std::size_t>(count));
  const auto put = [&](Clusters& clusters, std::size_t pixel, bool set, int rank) {
    clusters.put(pixel, set);
    ranks[pixel] = static_cast<std::uint16_t>(rank);
  };
  Clusters clusters = start;
  for (int rank = ones - 1; rank >= 0; --rank) put(clusters, clusters.tightest_cluster(), false, rank);
  clusters = start;
  for (int rank = ones; rank < count; ++rank) {
    put(clusters, clusters.largest_void(), true, rank);
    if (rank % 256 == 255) progress((rank + 1.0) / count);
  }
  return ranks;
}

}  // namespace penumbra::shadow
