#include "truth/sampling.h"

#include <bit>
#include <cmath>
#include <cstddef>

// Compiles a function for several vector widths; the processor's is chosen when the program starts. Disabled with the
// thread sanitizer: the function that chooses runs before the sanitizer is initialised.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_THREAD__)
#define TRUTH_WIDE_VECTORS __attribute__((target_clones("avx2", "default")))
#else
#define TRUTH_WIDE_VECTORS
#endif

namespace penumbra::truth {

namespace {

constexpr std::size_t lanes = packet_width;

// Wellons' "lowbias32" family of finalisers (2018), with constants of TheIronBorn.
constexpr std::uint32_t hash(std::uint32_t x) {
  x ^= x >> 16U;
  x *= 0x21f0aaadU;
  x ^= x >> 15U;
  x *= 0xd35a2d97U;
  return x ^ (x >> 15U);
}

// Owen scrambling: whether a digit is flipped depends only on the higher digits. Digits are reversed here, with the
// highest in bit 0.
constexpr std::uint32_t scrambled(std::uint32_t reversed, std::uint32_t seed) {
  reversed ^= reversed * 0x3d20adeaU;
  reversed += seed;
  reversed *= (seed >> 16U) | 1U;
  reversed ^= reversed * 0x05526c56U;
  return reversed ^ (reversed * 0x53a22864U);
}

constexpr std::uint32_t reversed_bits(std::uint32_t x) {
  x = (x >> 16U) | (x << 16U);
  x = ((x >> 8U) & 0x00ff00ffU) | ((x & 0x00ff00ffU) << 8U);
  x = ((x >> 4U) & 0x0f0f0f0fU) | ((x & 0x0f0f0f0fU) << 4U);
  x = ((x >> 2U) & 0x33333333U) | ((x & 0x33333333U) << 2U);
  return ((x >> 1U) & 0x55555555U) | ((x & 0x55555555U) << 1U);
}

// Sobol's second dimension, digits reversed. Its direction numbers are the powers of 1 + x over GF(2), so digit j is
// the parity of the index's bits k with j a subset of k, a transform of five steps. The first dimension is the index
// itself.
constexpr std::uint32_t second_dimension(std::uint32_t index) {
  index ^= (index >> 1U) & 0x55555555U;
  index ^= (index >> 2U) & 0x33333333U;
  index ^= (index >> 4U) & 0x0f0f0f0fU;
  index ^= (index >> 8U) & 0x00ff00ffU;
  return index ^ (index >> 16U);
}

// Moves bit i to bit 2 i.
constexpr std::uint32_t spread_bits(std::uint32_t x) {
  x = (x | x << 8U) & 0x00ff00ffU;
  x = (x | x << 4U) & 0x0f0f0f0fU;
  x = (x | x << 2U) & 0x33333333U;
  return (x | x << 1U) & 0x55555555U;
}

// The upper 24 bits as a float in [0, 1), which represents them exactly.
constexpr float unit(std::uint32_t bits) { return static_cast<float>(bits >> 8U) * 0x1p-24f; }

}  // namespace

PixelPoints::PixelPoints(std::uint32_t seed, std::uint32_t pixel, Scramblings scramblings) {
  const std::uint32_t of_pixel = hash(hash(seed) ^ pixel);
  const bool one = scramblings == Scramblings::one;
  stride_ = one ? packet_width : 1;
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const std::uint32_t own = hash(of_pixel + 0x9e3779b9U * static_cast<std::uint32_t>(one ? 0 : lane));
    starts_[lane] = static_cast<std::uint32_t>(one ? lane : 0);
    seeds_x_[lane] = hash(own ^ 0x85ebca6bU);
    seeds_y_[lane] = hash(own ^ 0xc2b2ae35U);
  }
}

TRUTH_WIDE_VECTORS void PixelPoints::square(std::uint32_t index, PacketPoints& points) const {
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const std::uint32_t own = index * stride_ + starts_[lane];
    points.x[lane] = unit(reversed_bits(scrambled(own, seeds_x_[lane])));
    points.y[lane] = unit(reversed_bits(scrambled(second_dimension(own), seeds_y_[lane])));
  }
}

PicturePoints::PicturePoints(std::uint32_t seed, std::uint32_t count)
    : count_(count), seed_x_(hash(hash(seed) ^ 0x85ebca6bU)), seed_y_(hash(hash(seed) ^ 0xc2b2ae35U)) {}

std::uint32_t PicturePoints::first(std::uint32_t x, std::uint32_t y) const {
  constexpr std::uint64_t all_points = 1ULL << 32U;
  const std::uint32_t pixel = spread_bits(x) | spread_bits(y) << 1U;
  if ((static_cast<std::uint64_t>(pixel) + 1) * count_ <= all_points) return pixel * count_;
  const auto pixels = static_cast<std::uint32_t>(std::bit_floor(all_points / count_));  // of a block
  constexpr std::uint32_t in_group = 3;  // pixels of 2 × 2 stay as they are
  return ((pixel ^ (hash(pixel / pixels) & ~in_group)) & (pixels - 1)) * count_;
}

TRUTH_WIDE_VECTORS void PicturePoints::square(const std::array<std::uint32_t, packet_width>& indices,
                                              PacketPoints& points) const {
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    points.x[lane] = unit(reversed_bits(scrambled(indices[lane], seed_x_)));
    points.y[lane] = unit(reversed_bits(scrambled(second_dimension(indices[lane]), seed_y_)));
  }
}

// concentric_disc() of glsl/lib/disc.glsl without branches, so that the compiler can vectorise it.
TRUTH_WIDE_VECTORS void square_to_disc(PacketPoints& points) {
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const float px = 2 * points.x[lane] - 1;
    const float py = 2 * points.y[lane] - 1;
    const bool wide = std::abs(px) > std::abs(py);
    const float radius = wide ? px : py;
    const float other = wide ? py : px;
    const float one_at_center = radius == 0 ? 1.0f : 0.0f;  // a choice of divisors would be compiled to a branch
    const float angle = 0.78539816f * (other / (radius + one_at_center));
    const float x = angle * angle;
    const float c = radius * (1 + x * (-0.5f + x * (4.1666667e-2f + x * (-1.3888889e-3f + x * 2.4801587e-5f))));
    const float s = radius * angle * (1 + x * (-0.16666667f + x * (8.3333333e-3f - x * 1.9841270e-4f)));
    points.x[lane] = wide ? c : s;
    points.y[lane] = wide ? s : c;
  }
}

void square_to_sides(PacketPoints& points) {
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    points.x[lane] = 2 * points.x[lane] - 1;
    points.y[lane] = 2 * points.y[lane] - 1;
  }
}

}  // namespace penumbra::truth
