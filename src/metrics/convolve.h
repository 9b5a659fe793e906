#pragma once

#include <span>
#include <vector>

namespace penumbra::metrics {

// A picture of one channel that owns its pixels, rows top to bottom.
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

// What filters read outside the picture: the nearest pixel, or 0.
enum class Border { nearest, zero };

// A filter kernel of 2 · radius + 1 taps; the middle one is at the pixel.
using Kernel = std::vector<float>;

// A Gaussian kernel that sums to 1; `sigma` in pixels.
Kernel gaussian(double sigma, int radius);

// Blurred by a Gaussian.
Plane blurred(const Plane& plane, double sigma, Border border);

// Separable correlation: with `across` along rows, then with `down` along columns.
Plane convolve(const Plane& plane, const Kernel& across, const Kernel& down, Border border);

}  // namespace penumbra::metrics
