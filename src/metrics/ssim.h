#pragma once

#include "metrics/image_view.h"

namespace penumbra::metrics {

// The mean structural similarity index over the receivers, −1 to 1 (the same): Wang, Bovik, Sheikh, Simoncelli, "Image
// Quality Assessment: From Error Visibility to Structural Similarity", IEEE Transactions on Image Processing 13(4),
// 2004.
//   (2 μx μy + C1)(2 σxy + C2) / ((μx² + μy² + C1)(σx² + σy² + C2)),  C1 = 0.01², C2 = 0.03²
// with means, variances and covariance under a Gaussian window of 11 × 11 pixels, σ = 1.5. The peak signal is 1. Of
// three channels the luma (Rec. 709 weights) is compared.
//
// A window includes only receivers inside the picture: other pixels have weight 0, and the remaining weights are
// renormalised to sum to 1. So pixels near the border are measured too, which the paper leaves out. A test value that
// is not finite counts as 0 or 1, whichever is farther from the reference, one beyond ±10⁶ as that. NaN without
// receivers. Throws Error as check() does, and for channels other than 1 and 3.
double ssim(const ImageView& test, const ImageView& reference, Receivers receivers = {});

}  // namespace penumbra::metrics
