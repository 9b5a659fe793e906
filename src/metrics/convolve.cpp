#include "metrics/convolve.h"

#include <algorithm>
#include <cmath>

namespace penumbra::metrics {

namespace {

// The inner loops run along a row, so that the compiler vectorises them.
void add_scaled(float* out, const float* in, float scale, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) out[i] += scale * in[i];
}

void convolve_row(const float* in, float* out, std::vector<float>& padded, const Kernel& kernel, Border border) {
  const std::size_t radius = kernel.size() / 2, width = padded.size() - 2 * radius;
  const bool nearest = border == Border::nearest;
  std::fill_n(padded.begin(), radius, nearest ? in[0] : 0.0f);
  std::copy_n(in, width, padded.begin() + static_cast<std::ptrdiff_t>(radius));
  std::fill_n(padded.end() - static_cast<std::ptrdiff_t>(radius), radius, nearest ? in[width - 1] : 0.0f);
  std::fill_n(out, width, 0.0f);
  for (std::size_t t = 0; t < kernel.size(); ++t) add_scaled(out, padded.data() + t, kernel[t], width);
}

Plane convolve_rows(const Plane& plane, const Kernel& kernel, Border border) {
  Plane result(plane.width, plane.height);
  std::vector<float> padded(static_cast<std::size_t>(plane.width) + kernel.size() - 1);
  for (int y = 0; y < plane.height; ++y) convolve_row(plane.row(y), result.row(y), padded, kernel, border);
  return result;
}

Plane convolve_columns(const Plane& plane, const Kernel& kernel, Border border) {
  Plane result(plane.width, plane.height);
  const int radius = static_cast<int>(kernel.size() / 2);
  for (int y = 0; y < plane.height; ++y) {
    for (int t = -radius; t <= radius; ++t) {
      const int from = std::clamp(y + t, 0, plane.height - 1);
      if (from != y + t && border == Border::zero) continue;
      add_scaled(result.row(y), plane.row(from), kernel[static_cast<std::size_t>(t + radius)],
                 static_cast<std::size_t>(plane.width));
    }
  }
  return result;
}

}  // namespace

Plane::Plane(int columns, int rows)
    : width(columns), height(rows), pixels(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows)) {}

Kernel gaussian(double sigma, int radius) {
  Kernel kernel;
  double sum = 0;
  for (int x = -radius; x <= radius; ++x) sum += std::exp(-x * x / (2 * sigma * sigma));
  for (int x = -radius; x <= radius; ++x)
    kernel.push_back(static_cast<float>(std::exp(-x * x / (2 * sigma * sigma)) / sum));
  return kernel;
}

Plane convolve(const Plane& plane, const Kernel& across, const Kernel& down, Border border) {
  return plane.pixels.empty() ? plane : convolve_columns(convolve_rows(plane, across, border), down, border);
}

Plane blurred(const Plane& plane, double sigma, Border border) {
  const Kernel kernel = gaussian(sigma, static_cast<int>(std::ceil(3 * sigma)));
  return convolve(plane, kernel, kernel, border);
}

}  // namespace penumbra::metrics
