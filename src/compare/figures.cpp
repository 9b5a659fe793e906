#include "compare/figures.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace penumbra::compare {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

// The mean squared error from its PSNR in dB: the inverse of metrics::psnr_of().
double mean_squared(double psnr) { return std::pow(10.0, -psnr / 10.0); }

}  // namespace

void FigureSums::Mean::add(double value, std::size_t weight) {
  if (std::isnan(value) || weight == 0) return;
  sum += value * static_cast<double>(weight);
  count += weight;
}

double FigureSums::Mean::mean() const { return count == 0 ? none : sum / static_cast<double>(count); }

void FigureSums::add_light(const metrics::ImageView& test, const metrics::ImageView& truth,
                           std::span<const std::uint8_t> receivers) {
  const metrics::Quality quality = metrics::quality_of(test, truth, receivers);
  const metrics::ErrorFigures& errors = quality.errors;
  squared_.add(errors.rmse * errors.rmse, errors.samples);
  squared_penumbra_.add(mean_squared(errors.psnr_penumbra), errors.penumbra_samples);
  bias_.add(errors.bias, errors.samples);
  p99_.add(errors.p99);
  not_finite_ += errors.not_finite;
  if (!std::isnan(errors.max)) max_ = std::max(max_, errors.max);
  ssim_.add(quality.ssim);
  flip_.add(quality.flip);
  width_error_.add(quality.width.relative);
  widths_.measured += quality.width.measured;
  widths_.lost += quality.width.lost;
}

void FigureSums::add(const std::vector<float>& visibility, const ReferenceFrame& reference, bool cut) {
  const std::size_t pixels = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  for (std::size_t light = 0; light < static_cast<std::size_t>(lights_); ++light) {
    const auto mask = [&](const auto& all) { return std::span(all).subspan(light * pixels, pixels); };
    add_light({.width = width_, .height = height_, .pixels = mask(visibility)},
              {.width = width_, .height = height_, .pixels = mask(reference.visibility)}, mask(reference.receivers));
  }
  const int rows = height_ * lights_;
  sequence_.add({.width = width_, .height = rows, .pixels = visibility},
                {.width = width_, .height = rows, .pixels = reference.visibility}, reference.receivers,
                cut ? metrics::Event::cut : metrics::Event::none);
  ++frames_;
}

ComparedFigures FigureSums::figures() const {
  ComparedFigures figures{.rmse = std::sqrt(squared_.mean()),
                          .psnr = metrics::psnr_of(squared_.mean()),
                          .rmse_penumbra = std::sqrt(squared_penumbra_.mean()),
                          .psnr_penumbra = metrics::psnr_of(squared_penumbra_.mean()),
                          .bias = bias_.mean(),
                          .max = squared_.count == 0 ? none : max_,
                          .p99 = p99_.mean(),
                          .ssim = ssim_.mean(),
                          .flip = flip_.mean(),
                          .width_error = width_error_.mean(),
                          .width_lost = widths_.lost_share(),
                          .not_finite = not_finite_,
                          .sequence = {}};
  if (frames_ > 1) figures.sequence = sequence_.figures();
  return figures;
}

}  // namespace penumbra::compare
