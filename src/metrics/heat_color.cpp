#include "metrics/heat_color.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace penumbra::metrics {

namespace {

using Rgb = std::array<std::uint8_t, 3>;

std::uint8_t encoded(double linear) {
  const double v = std::clamp(linear, 0.0, 1.0);
  return static_cast<std::uint8_t>(
      std::lround(255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055)));
}

Rgb of_oklab(double lightness, double a, double b) {
  const double l = std::pow(lightness + 0.3963377774 * a + 0.2158037573 * b, 3);
  const double m = std::pow(lightness - 0.1055613458 * a - 0.0638541728 * b, 3);
  const double s = std::pow(lightness - 0.0894841775 * a - 1.2914855480 * b, 3);
  return {encoded(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
          encoded(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
          encoded(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
}

Rgb on_path(double error) {
  const double lab = 96 * error;  // CIELAB's L*, which is perceptually uniform
  const double lightness = std::cbrt(lab > 8 ? std::pow((lab + 16) / 116, 3) : lab / 903.3);
  const double hue = (290 + 180 * error) * std::numbers::pi / 180;
  const double chroma = std::min(0.4 * lightness, 0.155);  // stays within the sRGB gamut for all errors
  return of_oklab(lightness, chroma * std::cos(hue), chroma * std::sin(hue));
}

}  // namespace

Rgb heat_color(float error) {
  static const std::array<Rgb, 256> table = [] {
    std::array<Rgb, 256> colors{};
    for (std::size_t i = 0; i < colors.size(); ++i) colors[i] = on_path(static_cast<double>(i) / 255);
    return colors;
  }();
  const float at = std::isnan(error) ? 1.0f : std::clamp(error, 0.0f, 1.0f);
  return table[static_cast<std::size_t>(std::lround(at * 255.0f))];
}

}  // namespace penumbra::metrics
