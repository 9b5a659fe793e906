#pragma once

#include <cstddef>

#include "metrics/image_view.h"

namespace penumbra::metrics {

// How much wider or narrower the test's penumbra is. At each receiver whose reference is in the penumbra
// (error_figures.h) both pictures are read along a line in the direction of the reference's gradient, and the distance
// is taken between the nearest places where they cross 10 % and 90 %: the width w. For a linear ramp that is 0.8 of the
// full width.
struct PenumbraWidth {
  double relative = 0;       // mean |w_test − w_reference| / w_reference; 0 at best, NaN where nothing was measured
  double relative_bias = 0;  // the same with its sign: above 0 where the test is too soft
  double pixels = 0;         // mean |w_test − w_reference|, pixels
  std::size_t measured = 0;  // pixels in the means
  std::size_t lost = 0;      // pixels with a width in the reference but none in the test, which are in no mean

  // Of the pixels with a width in the reference, 0 to 1; NaN where there are none.
  double lost_share() const;
};

// Lines end at the picture's border, at pixels that are no receivers, at values that are not finite, and after 256
// pixels either way: a pixel whose line ends before both crossings has no width. Reads are bilinear, so no width is
// under 0.8 pixels; noise crosses early, so a noisy penumbra reads as a narrow one. One channel. Throws Error as
// check() does, and for more channels.
PenumbraWidth penumbra_width(const ImageView& test, const ImageView& reference, Receivers receivers = {});

}  // namespace penumbra::metrics
