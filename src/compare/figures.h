#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "compare/comparison.h"
#include "compare/draw.h"
#include "metrics/quality.h"
#include "metrics/sequence.h"

namespace penumbra::compare {

// Accumulates the figures of a technique frame by frame. RMSE and PSNR are taken over the receivers of all frames
// and lights together; SSIM, FLIP and penumbra widths, which are not means over pixels, are averaged over them.
class FigureSums {
 public:
  // `lights`: how many masks a frame has, one below the other, each of that size.
  FigureSums(const cli::Size& size, int lights) : width_(size.width), height_(size.height), lights_(lights) {}

  // `cut`: view or time jumped before this frame.
  void add(const std::vector<float>& visibility, const ReferenceFrame& reference, bool cut);

  ComparedFigures figures() const;

 private:
  // A mean that leaves out missing values (NaN).
  struct Mean {
    double sum = 0;
    std::size_t count = 0;
    void add(double value, std::size_t weight = 1);
    double mean() const;
  };

  void add_light(const metrics::ImageView& test, const metrics::ImageView& truth,
                 std::span<const std::uint8_t> receivers);

  int width_, height_, lights_;
  std::size_t frames_ = 0;
  Mean squared_, squared_penumbra_, bias_, ssim_, flip_, width_error_, p99_;
  double max_ = 0;
  std::size_t not_finite_ = 0;
  metrics::PenumbraWidth widths_;  // only its counts are used, summed over all frames
  metrics::SequenceMetrics sequence_;
};

}  // namespace penumbra::compare
