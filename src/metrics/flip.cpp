#include "metrics/flip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "core/error.h"
#include "metrics/convolve.h"
#include "metrics/flip_color.h"

namespace penumbra::metrics {

namespace {

constexpr double pi = std::numbers::pi;
constexpr float color_exponent = 0.7f, color_knee = 0.4f, color_knee_error = 0.95f;  // q_c, p_c, p_t of the paper
constexpr double feature_width = 0.082;                                              // degrees: w of the paper

// A channel's contrast sensitivity: a sum of two Gaussians a √(π/b) exp(−π² x² / b), x in degrees.
struct Sensitivity {
  double a1, b1, a2, b2;
};
constexpr std::array<Sensitivity, 3> sensitivities{
    {{1, 0.0047, 0, 1e-5}, {1, 0.0053, 0, 1e-5}, {34.1, 0.04, 13.5, 0.025}}};

// The planes of luminance, red-green and blue-yellow; a grey picture has luminance only.
using Opponent = std::vector<Plane>;

Opponent opponent_of(const ImageView& picture, const ImageView& elsewhere, Receivers receivers) {
  const auto channels = static_cast<std::size_t>(picture.channels);
  Opponent planes(channels, Plane(picture.width, picture.height));
  for (std::size_t i = 0; i < picture.pixel_count(); ++i) {
    const float* shown = &(is_receiver(receivers, i) ? picture : elsewhere).pixels[i * channels];
    std::array<float, 3> linear{};
    for (std::size_t c = 0; c < channels; ++c)
      linear[c] = std::isfinite(shown[c]) ? srgb_decoded(std::clamp(shown[c], 0.0f, 1.0f)) : 0.0f;
    if (channels == 1) {
      planes[0].pixels[i] = 116.0f * linear[0] - 16.0f;
      continue;
    }
    const Color color = ycxcz_of_xyz(xyz_of_linear({linear[0], linear[1], linear[2]}));
    planes[0].pixels[i] = color.x;
    planes[1].pixels[i] = color.y;
    planes[2].pixels[i] = color.z;
  }
  return planes;
}

// Filters a plane by the contrast sensitivity. The two-dimensional kernel is normalised to 1, so each Gaussian is
// weighted by its volume.
Plane seen(const Plane& plane, const Sensitivity& s, float pixels_per_degree) {
  const double widest = std::sqrt(0.04 / (2 * pi * pi));  // degrees: the radius is the same for all channels
  const int radius = static_cast<int>(std::ceil(3 * widest * pixels_per_degree));
  const auto part = [&](double a, double b) {
    const double sigma = std::sqrt(b / (2 * pi * pi)) * pixels_per_degree;
    double sum = 0;
    for (int x = -radius; x <= radius; ++x) sum += std::exp(-x * x / (2 * sigma * sigma));
    return std::pair(gaussian(sigma, radius), a * std::sqrt(pi / b) * sum * sum);
  };
  const auto [first, first_volume] = part(s.a1, s.b1);
  Plane result = convolve(plane, first, first, Border::nearest);
  if (s.a2 == 0) return result;
  const auto [second, second_volume] = part(s.a2, s.b2);
  const Plane other = convolve(plane, second, second, Border::nearest);
  const auto share = static_cast<float>(first_volume / (first_volume + second_volume));
  for (std::size_t i = 0; i < result.pixels.size(); ++i)
    result.pixels[i] = share * result.pixels[i] + (1.0f - share) * other.pixels[i];
  return result;
}

Opponent seen(const Opponent& planes, float pixels_per_degree) {
  Opponent result;
  for (std::size_t c = 0; c < planes.size(); ++c)
    result.push_back(seen(planes[c], sensitivities[c], pixels_per_degree));
  return result;
}

Color lab_at(const Opponent& planes, std::size_t pixel) {
  if (planes.size() == 1) {
    const float y = std::clamp((planes[0].pixels[pixel] + 16.0f) / 116.0f, 0.0f, 1.0f);
    return {116.0f * lab_curve(y) - 16.0f, 0.0f, 0.0f};
  }
  const Color rgb =
      linear_of_xyz(xyz_of_ycxcz({planes[0].pixels[pixel], planes[1].pixels[pixel], planes[2].pixels[pixel]}));
  return hunt_lab_of_xyz(
      xyz_of_linear({std::clamp(rgb.x, 0.0f, 1.0f), std::clamp(rgb.y, 0.0f, 1.0f), std::clamp(rgb.z, 0.0f, 1.0f)}));
}

// The colour difference, 0 to 1, with most of the range for small differences. The largest possible one is between the
// screen's green and blue.
float color_error(const Color& a, const Color& b) {
  static const float greatest = std::pow(
      hyab(hunt_lab_of_xyz(xyz_of_linear({0, 1, 0})), hunt_lab_of_xyz(xyz_of_linear({0, 0, 1}))), color_exponent);
  const float difference = std::pow(hyab(a, b), color_exponent), knee = color_knee * greatest;
  if (difference < knee) return color_knee_error / knee * difference;
  return color_knee_error + (difference - knee) / (greatest - knee) * (1.0f - color_knee_error);
}

// First and second derivatives of a Gaussian, normalised so that positive taps sum to 1 and negative ones to −1.
struct FeatureKernels {
  Kernel smooth, edge, point;
};

Kernel balanced(Kernel kernel) {
  float positive = 0, negative = 0;
  for (const float tap : kernel) (tap > 0 ? positive : negative) += tap;
  for (float& tap : kernel) tap /= tap > 0 ? positive : -negative;
  return kernel;
}

FeatureKernels feature_kernels(float pixels_per_degree) {
  const double sigma = 0.5 * feature_width * pixels_per_degree;
  const int radius = static_cast<int>(std::ceil(3 * sigma));
  FeatureKernels kernels{gaussian(sigma, radius), {}, {}};
  for (int x = -radius; x <= radius; ++x) {
    const float weight = kernels.smooth[static_cast<std::size_t>(x + radius)];
    kernels.edge.push_back(static_cast<float>(-x) * weight);
    kernels.point.push_back(static_cast<float>(x * x / (sigma * sigma) - 1) * weight);
  }
  kernels.edge = balanced(std::move(kernels.edge));
  kernels.point = balanced(std::move(kernels.point));
  return kernels;
}

// The strength of edges or points: the length of the vector of filter responses along both axes, for luminance from 0
// to 1.
std::vector<float> features(const Plane& luminance, const Kernel& feature, const Kernel& smooth) {
  Plane across = convolve(luminance, feature, smooth, Border::nearest);
  const Plane down = convolve(luminance, smooth, feature, Border::nearest);
  for (std::size_t i = 0; i < across.pixels.size(); ++i) {
    const float x = across.pixels[i], y = down.pixels[i];
    across.pixels[i] = std::sqrt(x * x + y * y) / 116.0f;
  }
  return std::move(across.pixels);
}

// The feature error, 0 to 1: the larger of the differences in edges and in points.
std::vector<float> feature_errors(const Plane& test, const Plane& reference, float pixels_per_degree) {
  const FeatureKernels kernels = feature_kernels(pixels_per_degree);
  std::vector<float> errors(test.pixels.size());
  for (const Kernel* kernel : {&kernels.edge, &kernels.point}) {
    const std::vector<float> a = features(test, *kernel, kernels.smooth);
    const std::vector<float> b = features(reference, *kernel, kernels.smooth);
    for (std::size_t i = 0; i < errors.size(); ++i) errors[i] = std::max(errors[i], std::abs(a[i] - b[i]));
  }
  for (float& error : errors) error = std::sqrt(error * std::numbers::sqrt2_v<float> / 2);
  return errors;
}

bool all_finite(const ImageView& picture, std::size_t pixel) {
  const auto channels = static_cast<std::size_t>(picture.channels);
  const auto values = picture.pixels.subspan(pixel * channels, channels);
  return std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); });
}

}  // namespace

Flip flip(const ImageView& test, const ImageView& reference, Receivers receivers, float pixels_per_degree) {
  check(test, reference, receivers);
  if (reference.channels != 1 && reference.channels != 3)
    fail("FLIP compares pictures of 1 or 3 channels, not {}", reference.channels);
  const Opponent shown = opponent_of(test, reference, receivers), truth = opponent_of(reference, reference, receivers);
  const std::vector<float> feature = feature_errors(shown[0], truth[0], pixels_per_degree);
  const Opponent shown_seen = seen(shown, pixels_per_degree), truth_seen = seen(truth, pixels_per_degree);

  Flip result{0, std::vector<float>(reference.pixel_count())};
  std::size_t count = 0;
  for (std::size_t i = 0; i < result.map.size(); ++i) {
    if (!is_receiver(receivers, i)) continue;
    const float color = color_error(lab_at(shown_seen, i), lab_at(truth_seen, i));
    const float error = all_finite(test, i) ? std::pow(color, 1.0f - feature[i]) : 1.0f;
    result.map[i] = std::clamp(error, 0.0f, 1.0f);
    result.mean += result.map[i];
    ++count;
  }
  result.mean = count == 0 ? std::numeric_limits<double>::quiet_NaN() : result.mean / static_cast<double>(count);
  return result;
}

}  // namespace penumbra::metrics
