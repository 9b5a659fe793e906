#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <vector>

#include "metrics/image_view.h"

namespace penumbra::test {

// A picture of one channel that owns its values.
struct Grey {
  int width = 0, height = 0;
  std::vector<float> pixels;

  // By a function of the pixel's column and row.
  Grey(int columns, int rows, const std::function<double(int, int)>& value) : width(columns), height(rows) {
    for (int y = 0; y < rows; ++y)
      for (int x = 0; x < columns; ++x) pixels.push_back(static_cast<float>(value(x, y)));
  }
  Grey(int columns, int rows, float value) : Grey(columns, rows, [=](int, int) { return value; }) {}

  float& at(int x, int y) {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }
  operator metrics::ImageView() const { return {width, height, pixels}; }  // NOLINT(google-explicit-constructor)
};

// A shadow's edge through the middle, lit on the side that `degrees` points to (0: right, 90: down): a linear ramp of
// this width in pixels.
inline Grey ramp(int side, double degrees, double width) {
  const double radians = degrees * std::numbers::pi / 180, middle = (side - 1) / 2.0;
  return {side, side, [=](int x, int y) {
            const double along = (x - middle) * std::cos(radians) + (y - middle) * std::sin(radians);
            return std::clamp(0.5 + along / width, 0.0, 1.0);
          }};
}

}  // namespace penumbra::test
