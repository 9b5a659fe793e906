#include "metrics/ssim.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "metrics/convolve.h"

namespace penumbra::metrics {

namespace {

// Subtracted from all values, so that rounding does not cancel small variances.
constexpr float middle = 0.5f;
constexpr float c1 = 0.01f * 0.01f, c2 = 0.03f * 0.03f;
// Test values beyond it count as it: the index is 0 to many digits there, and their squares would overflow.
constexpr float most = 1e6f;

float value_at(const ImageView& picture, std::size_t pixel) {
  if (picture.channels == 1) return picture.pixels[pixel];
  const float* rgb = &picture.pixels[pixel * 3];
  return 0.2126f * rgb[0] + 0.7152f * rgb[1] + 0.0722f * rgb[2];
}

// For each pixel the windowed sum of `value` over the receivers, before division by the window's total weight.
template <class Value>
Plane sums(const ImageView& size, Receivers receivers, Value value) {
  static const Kernel window = gaussian(1.5, 5);
  Plane plane(size.width, size.height);
  for (std::size_t i = 0; i < plane.pixels.size(); ++i)
    if (is_receiver(receivers, i)) plane.pixels[i] = value(i);
  return convolve(plane, window, window, Border::zero);
}

}  // namespace

double ssim(const ImageView& test, const ImageView& reference, Receivers receivers) {
  check(test, reference, receivers);
  if (reference.channels != 1 && reference.channels != 3)
    fail("SSIM compares pictures of 1 or 3 channels, not {}", reference.channels);
  const auto truth = [&](std::size_t i) { return value_at(reference, i) - middle; };
  const auto shown = [&](std::size_t i) {
    const float value = value_at(test, i);
    if (!std::isfinite(value)) return (truth(i) <= 0 ? 1.0f : 0.0f) - middle;
    return std::clamp(value, -most, most) - middle;
  };
  const auto product = [](const auto& a, const auto& b) { return [&](std::size_t i) { return a(i) * b(i); }; };
  const Plane weight = sums(reference, receivers, [](std::size_t) { return 1.0f; });
  const Plane x = sums(reference, receivers, shown), xx = sums(reference, receivers, product(shown, shown));
  const Plane y = sums(reference, receivers, truth), yy = sums(reference, receivers, product(truth, truth));
  const Plane xy = sums(reference, receivers, product(shown, truth));

  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < weight.pixels.size(); ++i) {
    if (!is_receiver(receivers, i)) continue;
    const float w = weight.pixels[i], dx = x.pixels[i] / w, dy = y.pixels[i] / w;
    const float mx = dx + middle, my = dy + middle;
    // Clamped to the possible range: rounding must not make two pictures more similar than identical ones.
    const float variances = std::max(xx.pixels[i] / w - dx * dx, 0.0f) + std::max(yy.pixels[i] / w - dy * dy, 0.0f);
    const float covariance = std::clamp(xy.pixels[i] / w - dx * dy, -variances / 2, variances / 2);
    const float index = (2 * mx * my + c1) * (2 * covariance + c2) / ((mx * mx + my * my + c1) * (variances + c2));
    sum += std::min(index, 1.0f);
    ++count;
  }
  return count == 0 ? std::numeric_limits<double>::quiet_NaN() : sum / static_cast<double>(count);
}

}  // namespace penumbra::metrics
