#pragma once

#include <embree3/rtcore.h>

#include <array>
#include <cstdint>

#include "truth/embree_scene.h"
#include "truth/light.h"
#include "truth/receiver.h"
#include "truth/sampling.h"

namespace penumbra::truth {

// Of each scrambling's points, how many are lit.
using LitCounts = std::array<std::uint32_t, scrambling_count>;

// Traces one pixel's rays at a time, in packets. One a thread.
class PixelRays {
 public:
  PixelRays(const EmbreeScene& scene, const Light& light);

  // The rays from here on start at this receiver.
  void start_at(const Receiver& receiver);

  // Adds the points from `first` up to `last` (not included) of each scrambling.
  void trace(const PixelPoints& pixel, std::uint32_t first, std::uint32_t last, LitCounts& lit);

  // Whether the light's centre is seen.
  bool center_lit();

  long long traced() const { return traced_; }

 private:
  long aim(const PacketPoints& points);
  void count_lit(LitCounts& lit) const;

  const EmbreeScene& scene_;
  const Light& light_;
  long long traced_ = 0;
  SeenLight seen_;
  // Cosines to the receiver's normal, times the length: a ray's is center + x · side_x + y · side_y.
  double cosine_center_ = 0, cosine_x_ = 0, cosine_y_ = 0;
  RTCRay8 rays_;
  alignas(32) std::array<int, packet_width> valid_{};  // −1: to be traced
};

}  // namespace penumbra::truth
