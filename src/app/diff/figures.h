#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "image/picture.h"
#include "io/report.h"
#include "metrics/image_view.h"

namespace penumbra::app {

// A figure by which two pictures are compared. docs/metrics.md has its formula.
struct Metric {
  const char* name;
  const char* help;
  const char* unit;       // empty for none
  bool higher_is_better;  // then a limit on it is a minimum, else a maximum
  bool of_penumbrae = false;
};
std::span<const Metric> diff_metrics();
// Throws UsageError with near names for an unknown name.
const Metric& find_diff_metric(const std::string& name);

struct Figure {
  const Metric* metric = nullptr;
  double value = std::numeric_limits<double>::quiet_NaN();  // infinite for the PSNR of equal pictures
  std::string unfit;  // why the metric does not apply to these pictures; empty if it does
};

// All figures of two pictures of the same size, and the error of each pixel.
struct Difference {
  std::vector<Figure> figures;  // one per metric, in the order of diff_metrics()
  std::size_t samples = 0, penumbra_samples = 0;
  std::size_t not_finite = 0;                                    // values of the test picture
  double width_lost = std::numeric_limits<double>::quiet_NaN();  // metrics::PenumbraWidth::lost_share()
  std::vector<float> errors;                                     // one per pixel: the largest |error| of its channels
  std::vector<float> flip_map;                                   // empty if FLIP does not apply

  const Figure& figure(const Metric& metric) const;
};

// Throws Error if the pictures can't be compared; the message names `test_name` and `reference_name`.
void check_comparable(const image::Picture& test, const image::Picture& reference, metrics::Receivers receivers,
                      const std::string& test_name, const std::string& reference_name);
Difference difference_of(const image::Picture& test, const image::Picture& reference, metrics::Receivers receivers);

// Which pixels a mask of one channel selects: those whose value is finite and not 0. Throws Error, whose message begins
// with `name`, if there are none.
std::vector<std::uint8_t> selected_by(std::span<const float> mask, const std::string& name);

// The figures that apply to these pictures, by name, and penumbra_width_lost; NaN where there is no penumbra.
std::vector<std::pair<const char*, double>> named_figures(const Difference& difference);

// "rmse 0.0123, psnr 38.20 dB, …": every figure that applies to these pictures. The share of penumbra pixels without a
// measurable width follows the width error.
std::string text_of(const Difference& difference);
std::string text_of(const Figure& figure);  // with its unit; "inf" for an infinite one
// The named figures. Infinite ones are "inf", those of an empty penumbra are null.
io::Json to_json(const Difference& difference);

}  // namespace penumbra::app
