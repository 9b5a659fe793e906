#pragma once

#include <array>
#include <cstdint>

namespace penumbra::truth {

// Independent scramblings of one point set in each pixel, whose means' spread tells the error of their mean.
constexpr int scrambling_count = 8;
// Rays that are traced together: a point of each scrambling.
constexpr int packet_width = scrambling_count;

// Points of the unit square, or of the unit disc.
struct PacketPoints {
  alignas(32) std::array<float, packet_width> x;
  alignas(32) std::array<float, packet_width> y;
};

// The points of one pixel: the first two dimensions of Sobol's sequence (Sobol' 1967), in which a nested uniform
// scrambling (Owen 1995) permutes the digits. As many points of each scrambling as a power of two are one in each
// elementary interval of that area. Scrambled by hashing (Burley 2020, "Practical hash-based Owen scrambling") with
// Vegdahl's constants (2021, "Building a better LK hash").
class PixelPoints {
 public:
  // Points of different pixels, scramblings and seeds are independent.
  PixelPoints(std::uint32_t seed, std::uint32_t pixel);

  // Point number `index` of each scrambling, in the unit square, 1 excluded.
  void square(std::uint32_t index, PacketPoints& points) const;

 private:
  alignas(32) std::array<std::uint32_t, packet_width> seeds_x_;
  alignas(32) std::array<std::uint32_t, packet_width> seeds_y_;
};

// The unit square to the unit disc, equal areas to equal areas (Shirley and Chiu 1997, "A low distortion map between
// disk and square").
void square_to_disc(PacketPoints& points);

// The unit square to the one from −1 to 1.
void square_to_sides(PacketPoints& points);

}  // namespace penumbra::truth
