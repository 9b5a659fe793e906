#pragma once

#include <cstddef>
#include <vector>

#include "compare/comparison.h"
#include "compare/draw.h"
#include "metrics/quality.h"
#include "metrics/sequence.h"

namespace penumbra::compare {

// Accumulates the figures of a technique frame by frame. RMSE and PSNR are taken over the receivers of all frames
// together; SSIM, FLIP and penumbra widths, which are not means over pixels, are averaged over the frames.
class FigureSums {
 public:
  FigureSums(int width, int height) : width_(width), height_(height) {}

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

  int width_, height_;
  std::size_t frames_ = 0;
  Mean squared_, squared_penumbra_, bias_, ssim_, flip_, width_error_, p99_;
  double max_ = 0;
  metrics::PenumbraWidth widths_;  // only its counts are used, summed over all frames
  metrics::SequenceMetrics sequence_;
};

}  // namespace penumbra::compare
