#pragma once

#include <embree3/rtcore.h>

#include <array>
#include <cstdint>

#include "truth/embree_scene.h"
#include "truth/light.h"
#include "truth/receiver.h"
#include "truth/sampling.h"

namespace penumbra::truth {

// For each scrambling, how many of its points are lit.
using LitCounts = std::array<std::uint32_t, scrambling_count>;

// Where rays from a receiver start, relative to the scene's origin: off its plane by as much as single precision
// requires.
glm::vec3 start_of(const Receiver& receiver, const EmbreeScene& scene);

// Traces the rays of one pixel at a time, in packets. Each thread has its own.
class PixelRays {
 public:
  PixelRays(const EmbreeScene& scene, const TracedLight& light);

  // Sets the receiver at which the following rays start.
  void start_at(const Receiver& receiver);

  // Traces the points from `first` to `last` (exclusive) of each scrambling and adds the lit ones to `lit`.
  void trace(const PixelPoints& pixel, std::uint32_t first, std::uint32_t last, LitCounts& lit);

  // Whether the light's centre is visible from the receiver.
  bool center_lit();

  long long traced() const { return traced_; }

 private:
  long aim(const PacketPoints& points);
  void count_lit(LitCounts& lit) const;

  const EmbreeScene& scene_;
  const TracedLight& light_;
  long long traced_ = 0;
  SeenLight seen_;
  // Dot products with the receiver's normal of center, side_x and side_y; that of a ray is center + x · side_x + y ·
  // side_y.
  double cosine_center_ = 0, cosine_x_ = 0, cosine_y_ = 0;
  RTCRay8 rays_;
  alignas(32) std::array<int, packet_width> valid_{};  // Embree's mask: −1 traces the ray, 0 skips it
};

}  // namespace penumbra::truth
