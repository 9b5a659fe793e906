#pragma once

#include <cstddef>
#include <vector>

#include "metrics/error_figures.h"
#include "metrics/image_view.h"
#include "metrics/penumbra_width.h"

namespace penumbra::metrics {

// All metrics of one visibility picture against its reference.
struct Quality {
  ErrorFigures errors;
  double ssim = 0;
  double flip = 0;              // mean FLIP
  std::vector<float> flip_map;  // one value per pixel
  PenumbraWidth width;
};

// Measures a picture of one channel. Takes about half a second for 1280 x 720 pixels on one core, and error_figures()
// alone a fiftieth of that. Throws Error as check() does, and for more than one channel.
Quality quality_of(const ImageView& test, const ImageView& reference, Receivers receivers = {});

}  // namespace penumbra::metrics
