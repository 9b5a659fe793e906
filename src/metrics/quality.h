#pragma once

#include <cstddef>
#include <vector>

#include "metrics/error_figures.h"
#include "metrics/image_view.h"
#include "metrics/penumbra_width.h"

namespace penumbra::metrics {

// All figures of one visibility picture against its reference.
struct Quality {
  ErrorFigures errors;
  double ssim = 0;
  double flip = 0;              // the mean
  std::vector<float> flip_map;  // a value a pixel
  PenumbraWidth width;
};

// Of one channel. Takes about half a second for 1280 x 720 pixels on one core; error_figures() alone a fiftieth of it.
// Throws Error as check() does, and for more channels.
Quality quality_of(const ImageView& test, const ImageView& reference, Receivers receivers = {});

}  // namespace penumbra::metrics
