#include "app/diff/figures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "cli/usage.h"
#include "metrics/error_figures.h"
#include "metrics/flip.h"
#include "metrics/penumbra_width.h"
#include "metrics/ssim.h"

namespace penumbra::app {

namespace {

constexpr std::array<Metric, 9> all_metrics{{
    {"rmse", "Root of the mean squared error", "", false},
    {"psnr", "Peak signal-to-noise ratio", "dB", true},
    {"psnr_penumbra", "PSNR where the reference is from 0.02 to 0.98", "dB", true, /*of_penumbrae=*/true},
    {"bias", "Mean error, above 0 where A is brighter; --max limits its absolute value", "", false},
    {"max", "Greatest error", "", false},
    {"p99", "Error that 99 of 100 values don't exceed", "", false},
    {"ssim", "Mean structural similarity, 1 at best", "", true},
    {"flip", "Mean FLIP: how different the two look to a viewer who flips between them", "", false},
    {"penumbra_width_error", "Mean relative error of the penumbrae's widths", "", false,
     /*of_penumbrae=*/true},
}};

metrics::ImageView view(const image::Picture& picture) {
  return {picture.width, picture.height, picture.pixels, static_cast<int>(picture.channels.size())};
}

// The properties of a picture's values that decide which metrics apply to it.
struct Kind {
  bool unit_range = false;  // 0 to 1
  bool one_channel = false;
  bool shown = false;  // values for a display, or a visibility
};

// The first value at a receiver for which `wanted` holds, or none.
template <class Wanted>
std::optional<std::size_t> find_value(const image::Picture& picture, metrics::Receivers receivers, Wanted wanted) {
  for (std::size_t i = 0; i < picture.pixels.size(); ++i)
    if (wanted(picture.pixels[i]) && metrics::is_receiver(receivers, i / picture.channels.size())) return i;
  return {};
}

Kind kind_of(const image::Picture& reference, metrics::Receivers receivers) {
  constexpr float slack = 1e-6f;
  const auto outside = [](float v) { return v < -slack || v > 1 + slack; };
  const std::size_t channels = reference.channels.size();
  Kind kind;
  kind.unit_range = !find_value(reference, receivers, outside);
  kind.one_channel = channels == 1;
  kind.shown = kind.unit_range && (kind.one_channel || (channels == 3 && reference.display));
  return kind;
}

std::vector<float> pixel_errors(const image::Picture& test, const image::Picture& reference,
                                metrics::Receivers receivers) {
  const std::size_t channels = reference.channels.size();
  std::vector<float> errors(reference.pixels.size() / channels);
  for (std::size_t i = 0; i < reference.pixels.size(); ++i) {
    if (!metrics::is_receiver(receivers, i / channels)) continue;
    float& error = errors[i / channels];
    error = std::max(error, std::abs(metrics::signed_error(test.pixels[i], reference.pixels[i])));
  }
  return errors;
}

std::string described(const image::Picture& picture, const std::string& name) {
  return fmt::format("'{}' ({} x {}, {}{})", name, picture.width, picture.height, fmt::join(picture.channels, ""),
                     picture.display ? ", display" : ", linear");
}

}  // namespace

std::span<const Metric> diff_metrics() { return all_metrics; }

const Metric& find_diff_metric(const std::string& name) {
  std::vector<std::string> names;
  for (const Metric& metric : all_metrics) names.emplace_back(metric.name);
  cli::one_of("metric", name, names);
  return *std::find_if(all_metrics.begin(), all_metrics.end(), [&](const Metric& m) { return name == m.name; });
}

const Figure& Difference::figure(const Metric& metric) const {
  return *std::find_if(figures.begin(), figures.end(), [&](const Figure& f) { return f.metric == &metric; });
}

void check_comparable(const image::Picture& test, const image::Picture& reference, metrics::Receivers receivers,
                      const std::string& test_name, const std::string& reference_name) {
  const auto refuse = [&](const char* cause) {
    fail("cannot compare {} with {}: {}", described(test, test_name), described(reference, reference_name), cause);
  };
  if (test.width != reference.width || test.height != reference.height) refuse("they differ in size");
  if (test.channels.size() != reference.channels.size()) refuse("they differ in channels");
  // Pictures of one channel store the value itself (a visibility, for example), whichever kind they claim to be.
  if (test.display != reference.display && test.channels.size() != 1) refuse("one holds display values, one linear");
  const auto bad = find_value(reference, receivers, [](float v) { return !std::isfinite(v); });
  if (!bad) return;
  const std::size_t pixel = *bad / reference.channels.size();
  const auto width = static_cast<std::size_t>(reference.width);
  fail("cannot compare with '{}': its value at pixel {},{} is not finite", reference_name, pixel % width,
       pixel / width);
}

std::vector<std::uint8_t> selected_by(std::span<const float> mask, const std::string& name) {
  std::vector<std::uint8_t> selected;
  selected.reserve(mask.size());
  for (const float value : mask) selected.push_back(value == 0 || !std::isfinite(value) ? 0 : 1);
  if (std::ranges::find(selected, 1) == selected.end()) fail("{} leaves no pixel", name);
  return selected;
}

Difference difference_of(const image::Picture& test, const image::Picture& reference, metrics::Receivers receivers) {
  const metrics::ImageView a = view(test), b = view(reference);
  const Kind kind = kind_of(reference, receivers);
  const metrics::ErrorFigures errors = metrics::error_figures(a, b, receivers);
  Difference difference;
  difference.samples = errors.samples;
  difference.penumbra_samples = kind.one_channel && kind.unit_range ? errors.penumbra_samples : 0;
  difference.not_finite = errors.not_finite;
  difference.errors = pixel_errors(test, reference, receivers);

  const auto add = [&](double value) {
    difference.figures.push_back({&all_metrics[difference.figures.size()], value, {}});
  };
  const auto add_if = [&](bool fits, const char* needs, const auto& value) {
    add(fits ? value() : std::numeric_limits<double>::quiet_NaN());
    if (!fits) difference.figures.back().unfit = needs;
  };
  const bool penumbra = kind.one_channel && kind.unit_range;
  const char* const needs_range = "needs a reference from 0 to 1";
  const char* const needs_one = "needs one channel from 0 to 1";
  const char* const needs_shown = "needs a PNG, or one channel from 0 to 1";
  add(errors.rmse);
  add_if(kind.unit_range, needs_range, [&] { return errors.psnr; });
  add_if(penumbra, needs_one, [&] { return errors.psnr_penumbra; });
  add(errors.bias);
  add(errors.max);
  add(errors.p99);
  add_if(kind.shown, needs_shown, [&] { return metrics::ssim(a, b, receivers); });
  add_if(kind.shown, needs_shown, [&] {
    metrics::Flip flip = metrics::flip(a, b, receivers);
    difference.flip_map = std::move(flip.map);
    return flip.mean;
  });
  add_if(penumbra, needs_one, [&] {
    const metrics::PenumbraWidth width = metrics::penumbra_width(a, b, receivers);
    difference.width_lost = width.lost_share();
    return width.relative;
  });
  return difference;
}

std::string text_of(const Figure& figure) {
  // Prints "0" instead of "-0" for small negative values.
  if (*figure.metric->unit != '\0')
    return fmt::format("{:.2f} {}", std::round(figure.value * 100) / 100 + 0.0, figure.metric->unit);
  return fmt::format("{:.5g}", figure.value);
}

std::string text_of(const Difference& difference) {
  std::vector<std::string> parts;
  for (const Figure& figure : difference.figures) {
    if (std::isnan(figure.value)) continue;
    parts.push_back(fmt::format("{} {}", figure.metric->name, text_of(figure)));
  }
  if (difference.width_lost > 0)
    parts.push_back(fmt::format("penumbra widths lost {:.3g} %", 100 * difference.width_lost));
  if (difference.not_finite > 0) parts.push_back(fmt::format("{} values not finite", difference.not_finite));
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::vector<std::pair<const char*, double>> named_figures(const Difference& difference) {
  std::vector<std::pair<const char*, double>> named;
  for (const Figure& figure : difference.figures) {
    if (!figure.unfit.empty()) continue;
    named.emplace_back(figure.metric->name, figure.value);
    if (std::string_view(figure.metric->name) == "penumbra_width_error")
      named.emplace_back("penumbra_width_lost", difference.width_lost);
  }
  return named;
}

io::Json to_json(const Difference& difference) {
  io::Json figures = io::Json::object();
  for (const auto& [name, value] : named_figures(difference)) figures[name] = io::json_number(value);
  return figures;
}

}  // namespace penumbra::app
