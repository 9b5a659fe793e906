#pragma once

#include <array>
#include <cstdint>

namespace penumbra::truth {

// Each pixel uses this many independent scramblings of one point set. The spread of their means estimates the standard
// error of the overall mean.
constexpr int scrambling_count = 8;
// Rays that are traced together: one point of each scrambling.
constexpr int packet_width = scrambling_count;

// One: all points of a pixel are the first ones of a single scrambling. They cover the light more evenly, but nothing
// estimates their error.
enum class Scramblings { eight, one };

// A point of each scrambling, in the unit square or the unit disc.
struct PacketPoints {
  alignas(32) std::array<float, packet_width> x;
  alignas(32) std::array<float, packet_width> y;
};

// The sample points of one pixel: the first two dimensions of Sobol's sequence (Sobol' 1967) with nested uniform
// scrambling (Owen 1995). Of the first 2^k points of each scrambling, exactly one is in each elementary interval of
// area 2^-k. The scrambling is computed by hashing (Burley 2020, "Practical hash-based Owen scrambling") with Vegdahl's
// constants (2021, "Building a better LK hash").
class PixelPoints {
 public:
  // Points of different pixels, scramblings and seeds are independent.
  PixelPoints(std::uint32_t seed, std::uint32_t pixel, Scramblings scramblings = Scramblings::eight);

  // Point number `index` of each scrambling, in the unit square [0, 1)²; of a single scrambling, the points from
  // `index` · packet_width on.
  void square(std::uint32_t index, PacketPoints& points) const;

 private:
  std::uint32_t stride_ = 1;
  alignas(32) std::array<std::uint32_t, packet_width> starts_{};
  alignas(32) std::array<std::uint32_t, packet_width> seeds_x_;
  alignas(32) std::array<std::uint32_t, packet_width> seeds_y_;
};

// The sample points of all pixels of a picture, from one scrambled sequence: each pixel takes `count` points that
// follow each other, and blocks of 2 × 2, 4 × 4, … pixels do too, because pixels are in Morton order. So the points of
// a pixel cover the light evenly, those of its block do so even better, and neighbours' errors cancel when they are
// averaged (after Ahmed and Wonka 2020, "Screen-space blue-noise diffusion of Monte Carlo sampling error via
// hierarchical ordering of pixels"). The sequence has 2^32 points. Where they do not suffice, such as beyond 1024 ×
// 1024 pixels of 4096 points, further blocks take them again in another order of pixels, so that no pixel has the
// points of one that is always as far away.
class PicturePoints {
 public:
  PicturePoints(std::uint32_t seed, std::uint32_t count);

  // The index of the first point of a pixel.
  std::uint32_t first(std::uint32_t x, std::uint32_t y) const;
  // Any points, by their indices, in the unit square [0, 1)².
  void square(const std::array<std::uint32_t, packet_width>& indices, PacketPoints& points) const;

 private:
  std::uint32_t count_, seed_x_, seed_y_;
};

// Maps the unit square to the unit disc with equal areas (Shirley and Chiu 1997, "A low distortion map between disk and
// square").
void square_to_disc(PacketPoints& points);

// Maps the unit square to the square from −1 to 1.
void square_to_sides(PacketPoints& points);

}  // namespace penumbra::truth
