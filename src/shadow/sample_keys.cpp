#include "sample_keys.h"

#include <glm/geometric.hpp>

#include "../core/random.h"
#include "lib/disc.glsl"
#include "noise_tiles.h"

namespace penumbra::shadow {

namespace {

constexpr int digits = 8;

// The digits of Sobol's first dimension: the index's, in reverse.
unsigned mirrored(unsigned index) {
  unsigned result = 0;
  for (int digit = 0; digit < digits; ++digit) result |= ((index >> digit) & 1U) << (digits - 1 - digit);
  return result;
}

// Those of its second dimension, whose direction numbers are the powers of 1 + x over the field of two elements.
unsigned second_dimension(unsigned index) {
  unsigned result = 0;
  for (unsigned direction = 1U << (digits - 1); index != 0; index >>= 1U, direction ^= direction >> 1U) {
    if ((index & 1U) != 0) result ^= direction;
  }
  return result;
}

// Owen's scrambling: whether a digit is flipped depends on all higher digits.
class Scrambling {
 public:
  explicit Scrambling(Random& random) {
    for (unsigned& flip : flips_) flip = random.below(2);
  }

  std::uint8_t operator()(unsigned value) const {
    unsigned result = 0, node = 1;  // of the tree whose path is the higher digits
    for (int digit = digits - 1; digit >= 0; --digit) {
      const unsigned bit = (value >> digit) & 1U;
      result = 2 * result + (bit ^ flips_[node]);
      node = 2 * node + bit;
    }
    return static_cast<std::uint8_t>(result);
  }

 private:
  std::array<unsigned, 1U << digits> flips_{};
};

glm::vec2 middle(unsigned x, unsigned y) { return (glm::vec2(x, y) + 0.5F) / 256.0F; }

}  // namespace

const std::array<glm::u8vec2, keyed_point_count>& keyed_points() {
  static const auto points = [] {
    Random random(1);
    const Scrambling x(random), y(random);
    std::array<glm::u8vec2, keyed_point_count> made{};
    for (unsigned i = 0; i < keyed_point_count; ++i) made[i] = {x(mirrored(i)), y(second_dimension(i))};
    return made;
  }();
  return points;
}

glm::vec2 keyed_point(const SampleKey& key, int index) {
  const glm::u8vec2 point = keyed_points()[static_cast<std::size_t>(index ^ key.order)];
  return middle(static_cast<unsigned>(point.x ^ key.x), static_cast<unsigned>(point.y ^ key.y));
}

KeyTile built_in_sample_keys() {
  KeyTile tile{.size = built_in_noise_side, .keys = {}};
  for (std::size_t i = 0; i < sample_keys_tile.size(); i += 3) {
    tile.keys.push_back({.x = static_cast<std::uint8_t>(sample_keys_tile[i]),
                         .y = static_cast<std::uint8_t>(sample_keys_tile[i + 1]),
                         .order = static_cast<std::uint8_t>(sample_keys_tile[i + 2])});
  }
  return tile;
}

std::vector<double> key_errors(const KeyTile& tile, int count, glm::vec2 direction, float offset) {
  const auto inside = [&](glm::vec2 point) {
    return glm::dot(glsl::concentric_disc(point), direction) > offset ? 1 : 0;
  };
  int cells = 0;
  for (unsigned y = 0; y < 256; ++y) {
    for (unsigned x = 0; x < 256; ++x) cells += inside(middle(x, y));
  }
  std::vector<double> errors;
  for (const SampleKey& key : tile.keys) {
    int samples = 0;
    for (int i = 0; i < count; ++i) samples += inside(keyed_point(key, i));
    errors.push_back(static_cast<double>(samples) / count - cells / 65536.0);
  }
  return errors;
}

}  // namespace penumbra::shadow
