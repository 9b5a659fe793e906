#pragma once

#include <span>
#include <vector>

namespace penumbra::metrics {

// A picture of one channel of our own, rows top to bottom.
struct Plane {
  int width = 0, height = 0;
  std::vector<float> pixels;

  Plane() = default;
  Plane(int columns, int rows);
  float* row(int y) { return pixels.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width); }
  const float* row(int y) const {
    return pixels.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
  }
};

// What lies outside the picture: the nearest pixel's value, or 0.
enum class Border { nearest, zero };

// Of 2 · radius + 1 taps, the middle one at the pixel.
using Kernel = std::vector<float>;

// A Gaussian that sums to 1; `sigma` in pixels.
Kernel gaussian(double sigma, int radius);

// Correlation with across(x) · down(y), one after the other.
Plane convolve(const Plane& plane, const Kernel& across, const Kernel& down, Border border);

}  // namespace penumbra::metrics
