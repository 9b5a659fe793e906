#include "metrics/error_figures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace penumbra::metrics {

namespace {

struct Sums {
  double squares = 0, penumbra_squares = 0, errors = 0;
};

double mean(double sum, std::size_t count) {
  return count == 0 ? std::numeric_limits<double>::quiet_NaN() : sum / static_cast<double>(count);
}

double percentile(std::vector<float>& values, std::size_t hundredths) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const std::size_t rank = (values.size() * hundredths + 99) / 100;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(rank - 1);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace

// Written as log10(1 / error) so that an error of 1 gives 0, not -0.
double psnr_of(double mean_squared_error) { return 10 * std::log10(1 / mean_squared_error); }

ErrorFigures error_figures(const ImageView& test, const ImageView& reference, Receivers receivers) {
  check(test, reference, receivers);
  ErrorFigures figures;
  Sums sums;
  std::vector<float> sizes;
  sizes.reserve(reference.pixels.size());
  const auto channels = static_cast<std::size_t>(reference.channels);
  for (std::size_t i = 0; i < reference.pixels.size(); ++i) {
    if (!is_receiver(receivers, i / channels)) continue;
    const float truth = reference.pixels[i], error = signed_error(test.pixels[i], truth);
    const double square = static_cast<double>(error) * error;
    figures.not_finite += std::isfinite(test.pixels[i]) ? 0 : 1;
    sums.errors += error;
    sums.squares += square;
    sizes.push_back(std::abs(error));
    if (truth < penumbra_low || truth > penumbra_high) continue;
    sums.penumbra_squares += square;
    ++figures.penumbra_samples;
  }
  figures.samples = sizes.size();
  const double squared = mean(sums.squares, figures.samples);
  figures.rmse = std::sqrt(squared);
  figures.psnr = psnr_of(squared);
  figures.psnr_penumbra = psnr_of(mean(sums.penumbra_squares, figures.penumbra_samples));
  figures.bias = mean(sums.errors, figures.samples);
  figures.max = sizes.empty() ? figures.bias : *std::max_element(sizes.begin(), sizes.end());
  figures.p99 = percentile(sizes, 99);
  return figures;
}

}  // namespace penumbra::metrics
