#include "metrics/penumbra_width.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/error.h"
#include "metrics/convolve.h"
#include "metrics/error_figures.h"

namespace penumbra::metrics {

namespace {

constexpr float low_level = 0.1f, high_level = 0.9f;
constexpr float farthest = 256.0f, stride = 0.5f;  // pixels
constexpr float least_slope = 1e-4f;               // per pixel; below it the gradient has no reliable direction
constexpr double smoothing = 1.5;                  // pixels: the Gaussian's σ before the gradient

struct Point {
  float x = 0, y = 0;  // pixels; whole numbers are pixel centres
};

struct Field {
  const ImageView& picture;
  Receivers receivers;

  // NaN outside the picture and at pixels that are no receivers.
  float at(int x, int y) const {
    if (x < 0 || y < 0 || x >= picture.width || y >= picture.height) return std::numeric_limits<float>::quiet_NaN();
    const std::size_t i =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(x);
    return is_receiver(receivers, i) ? picture.pixels[i] : std::numeric_limits<float>::quiet_NaN();
  }

  float bilinear(const Point& point) const {
    // Snapped, since rounding must not move a line along the border out of the picture.
    const auto snapped = [](float v) { return std::abs(v - std::round(v)) < 1e-3f ? std::round(v) : v; };
    const Point p{snapped(point.x), snapped(point.y)};
    const float left = std::floor(p.x), top = std::floor(p.y), u = p.x - left, v = p.y - top;
    const int x = static_cast<int>(left), y = static_cast<int>(top);
    // A pixel of weight 0 is not read: it may be outside the picture.
    const auto mixed = [&](int row) { return u == 0 ? at(x, row) : (1 - u) * at(x, row) + u * at(x + 1, row); };
    return v == 0 ? mixed(y) : (1 - v) * mixed(y) + v * mixed(y + 1);
  }
};

// A picture sampled along a line; `direction` has length 1 and points towards the lit side.
struct Line {
  const Field& field;
  Point origin, direction;

  float at(float distance) const {
    return field.bilinear({origin.x + distance * direction.x, origin.y + distance * direction.y});
  }

  // The position on the line at which the picture crosses the level, searched from the origin in the direction of the
  // level.
  std::optional<float> crossing(float level) const {
    float last = at(0);
    const bool above = last >= level;
    const float step = above ? -stride : stride;
    for (float s = step; std::abs(s) <= farthest; s += step) {
      const float value = at(s);
      if (!std::isfinite(value) || !std::isfinite(last)) return {};
      if ((value >= level) != above) return s - step * (value - level) / (value - last);
      last = value;
    }
    return {};
  }

  std::optional<float> width() const {
    const std::optional<float> high = crossing(high_level);
    const std::optional<float> low = high ? crossing(low_level) : std::nullopt;
    if (!low) return {};
    return *high - *low;
  }
};

// The reference, smoothed over its receivers; 0 far from all of them.
Plane smoothed(const ImageView& picture, Receivers receivers) {
  Plane values(picture.width, picture.height), weights(picture.width, picture.height);
  for (std::size_t i = 0; i < values.pixels.size(); ++i) {
    if (!is_receiver(receivers, i)) continue;
    values.pixels[i] = picture.pixels[i];
    weights.pixels[i] = 1.0f;
  }
  values = blurred(values, smoothing, Border::zero);
  weights = blurred(weights, smoothing, Border::zero);
  for (std::size_t i = 0; i < values.pixels.size(); ++i)
    if (weights.pixels[i] > 0) values.pixels[i] /= weights.pixels[i];
  return values;
}

// The gradient's direction by central differences, one-sided at the border; length 1, or nothing where the picture is
// flat.
std::optional<Point> direction_at(const Plane& plane, int x, int y) {
  const int left = std::max(x - 1, 0), right = std::min(x + 1, plane.width - 1);
  const int top = std::max(y - 1, 0), bottom = std::min(y + 1, plane.height - 1);
  const float dx = (plane.row(y)[right] - plane.row(y)[left]) / static_cast<float>(std::max(right - left, 1));
  const float dy = (plane.row(bottom)[x] - plane.row(top)[x]) / static_cast<float>(std::max(bottom - top, 1));
  const float slope = std::hypot(dx, dy);
  if (!(slope >= least_slope)) return {};
  return Point{dx / slope, dy / slope};
}

}  // namespace

double PenumbraWidth::lost_share() const {
  const std::size_t all = measured + lost;
  return all == 0 ? std::numeric_limits<double>::quiet_NaN() : static_cast<double>(lost) / static_cast<double>(all);
}

PenumbraWidth penumbra_width(const ImageView& test, const ImageView& reference, Receivers receivers) {
  check(test, reference, receivers);
  if (reference.channels != 1) fail("a penumbra's width is measured in 1 channel, not {}", reference.channels);
  const Plane smooth = smoothed(reference, receivers);
  const Field shown{test, receivers}, truth{reference, receivers};
  PenumbraWidth result;
  for (int y = 0; y < reference.height; ++y) {
    for (int x = 0; x < reference.width; ++x) {
      const float value = truth.at(x, y);
      if (!(value >= penumbra_low && value <= penumbra_high)) continue;
      const std::optional<Point> direction = direction_at(smooth, x, y);
      if (!direction) continue;
      const Point origin{static_cast<float>(x), static_cast<float>(y)};
      const std::optional<float> expected = Line{truth, origin, *direction}.width();
      if (!expected || *expected <= 0) continue;
      const std::optional<float> width = Line{shown, origin, *direction}.width();
      if (!width) {
        ++result.lost;
        continue;
      }
      const double difference = static_cast<double>(*width) - *expected;
      ++result.measured;
      result.relative += std::abs(difference) / *expected;
      result.relative_bias += difference / *expected;
    }
  }
  const auto count = static_cast<double>(result.measured);
  for (double* sum : {&result.relative, &result.relative_bias})
    *sum = result.measured == 0 ? std::numeric_limits<double>::quiet_NaN() : *sum / count;
  return result;
}

}  // namespace penumbra::metrics
