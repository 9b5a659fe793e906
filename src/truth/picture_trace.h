#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "truth/pixel_rays.h"
#include "truth/tracer.h"

namespace penumbra::truth {

// Traces one picture.
class PictureTrace {
 public:
  PictureTrace(const EmbreeScene& scene, std::span<const Receiver> receivers, int width, const TracedLight& light,
               const TraceOptions& options);

  // May be called once. Throws Interrupted.
  Traced trace();

 private:
  // The share of all work that is done before and after a round.
  struct Shares {
    double begin = 0, end = 1;
  };

  void run_round(const Shares& shares);
  void work(const Shares& shares, bool reports);
  bool report(double share);
  void trace_tile(std::size_t tile, PixelRays& rays);
  void trace_pixel(std::size_t pixel, PixelRays& rays);
  bool resolved(std::size_t pixel) const;
  bool differs_from_neighbour(std::size_t pixel) const;
  bool choose_next();
  Shares shares_of_next() const;

  const EmbreeScene& scene_;
  std::span<const Receiver> receivers_;
  std::size_t width_, height_;
  const TracedLight& light_;
  const TraceOptions& options_;
  int threads_;

  // Within a round only one thread writes a given pixel.
  Traced out_;
  std::vector<LitCounts> lit_;         // one per pixel, if there may be another round
  std::vector<std::uint32_t> points_;  // traced so far, of each scrambling
  std::vector<std::uint32_t> wanted_;  // after this round

  std::atomic<std::size_t> next_tile_ = 0;
  std::atomic<long long> rays_ = 0;
  std::atomic<bool> stopped_ = false;
  double reported_ = 0;
};

}  // namespace penumbra::truth
