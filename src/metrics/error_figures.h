#pragma once

#include <cstddef>

#include "metrics/image_view.h"

namespace penumbra::metrics {

// Receivers whose reference visibility is between these (both inclusive) are in the penumbra.
constexpr float penumbra_low = 0.02f, penumbra_high = 0.98f;

// Error statistics over single values, with e = test − reference over the receivers. A figure without any values is
// NaN.
struct ErrorFigures {
  std::size_t samples = 0;           // values that were measured: receivers times channels
  std::size_t penumbra_samples = 0;  // of them, those whose reference is in the penumbra
  std::size_t not_finite = 0;        // of them, test values that are NaN or infinite; each counts as |e| = 1
  double rmse = 0;                   // √(mean e²); 0 at best
  double psnr = 0;                   // psnr_of(mean e²), dB; infinite for equal pictures
  double psnr_penumbra = 0;          // the same over the penumbra alone
  double bias = 0;                   // mean e, −1 to 1 for visibility; above 0 where the test is too bright
  double max = 0;                    // greatest |e|
  double p99 = 0;                    // 99th percentile of |e| by nearest rank: 99 of 100 values are off by no more
};

// Peak signal-to-noise ratio, 10 log₁₀(1 / mean squared error), dB, for a peak signal of 1. Infinite for an error of 0.
double psnr_of(double mean_squared_error);

// Throws Error as check() does.
ErrorFigures error_figures(const ImageView& test, const ImageView& reference, Receivers receivers = {});

}  // namespace penumbra::metrics
