#pragma once

#include <cstddef>

#include "metrics/image_view.h"

namespace penumbra::metrics {

// How much wider or narrower the test's penumbra is than the reference's. At each receiver whose reference is in the
// penumbra (error_figures.h) both pictures are sampled along a line in the direction of the reference's gradient. The
// width w is the distance between the nearest points where a picture crosses 10 % and 90 %; for a linear ramp that is
// 0.8 of the full width.
struct PenumbraWidth {
  double relative = 0;       // mean |w_test − w_reference| / w_reference; 0 at best, NaN where nothing was measured
  double relative_bias = 0;  // mean signed difference; above 0 where the test is too soft
  std::size_t measured = 0;  // pixels in the means
  std::size_t lost = 0;      // pixels with a width in the reference but none in the test; excluded from the means

  // `lost` as a share of the pixels with a width in the reference, 0 to 1; NaN if there are none.
  double lost_share() const;
};

// Lines end at the picture's border, at pixels that are no receivers, at values that are not finite, and after 256
// pixels in each direction: a pixel whose line ends before both crossings has no width. Sampling is bilinear, so no
// width is below 0.8 pixels. Noise causes early crossings, so a noisy penumbra measures as too narrow. Takes one
// channel. Throws Error as check() does, and for more than one channel.
PenumbraWidth penumbra_width(const ImageView& test, const ImageView& reference, Receivers receivers = {});

}  // namespace penumbra::metrics
