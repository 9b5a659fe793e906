// Figures 4.12 and 4.13: the method compared with brute force, and the cost of taps.
#include <fmt/format.h>

#include <algorithm>

#include "bench/measure.h"
#include "image/read.h"
#include "report/number.h"
#include "report/table.h"
#include "report/text_blocks.h"
#include "reproduce/crops.h"
#include "reproduce/figures.h"

namespace penumbra::reproduce {

namespace {

constexpr double order_of_magnitude = 10, alike = 30;  // dB

bench::Options sweep_options(const Options& options) {
  bench::Options sweep;
  static_cast<cli::SceneOptions&>(sweep) = static_cast<const cli::SceneOptions&>(options);
  static_cast<cli::DeviceOptions&>(sweep) = static_cast<const cli::DeviceOptions&>(options);
  sweep.techniques = {"pcss"};
  sweep.assignments = {"pcss.early_exit=off"};  // with it, skipped taps would cost nothing
  sweep.sweep = "taps";
  sweep.quiet = options.quiet;
  if (options.quick) {
    sweep.frame_count = 2;
    sweep.warmup = 1;
  }
  return sweep;
}

report::Html heat_map(const bench::Results& results) {
  report::HeatMap map{.caption = fmt::format("{}, medians", bench::subject_of(results.sweep)),
                      .row_title = "blocker taps",
                      .column_title = "filter taps",
                      .row_names = {},
                      .column_names = {},
                      .values = {},
                      .unit = "ms"};
  const auto add = [](std::vector<std::string>& names, const std::string& name) {
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  };
  for (const bench::Measured& measured : results.points) {
    add(map.row_names, measured.point.names[0]);
    add(map.column_names, measured.point.names[1]);
    map.values.push_back(measured.costs.front().swept.median);
  }
  return report::to_html(map);
}

}  // namespace

Finding figure_4_12(Workbench& bench) {
  const NamedConfig many{"256×256 taps", {"brute_force", {}}};
  const NamedConfig few{"8×8 taps with blue noise and a bilateral filter", {"thesis_8x8", {}}};
  const MeasuredPicture& drawing = bench.draw(few.config);
  const std::vector<double> costs = bench.costs({many.config, few.config});
  Finding finding;
  finding.id = "4.12";
  finding.title = "Result";
  finding.claim =
      "8×8 taps, blue noise, Hammersley points and a bilateral filter look much like 256×256 taps at a small part of "
      "their cost (1.51 against 20.12 ms on a GeForce RTX 2080 Ti); the penumbra grows slightly.";
  finding.test =
      "Cost of all shadow passes on this machine, which must be an order of magnitude apart: with maps drawn anew and "
      "a median of blocker distances (section 3.4), where the thesis's 1.51 ms are PCSS and the bilateral filter "
      "alone. PSNR in the penumbra against converged PCSS, at least 30 dB; and the mean growth of penumbra widths, "
      "which must be above 0 for the penumbra to have grown.";
  const auto figure = [&](const std::string& label, const std::vector<float>& pixels) {
    return report::Figure{.label = label,
                          .alt = "The visible share of the sun, " + label,
                          .picture = grey_picture(pixels, bench.width(), bench.height())};
  };
  finding.body = report::tiles(
      {{.title = "8×8 taps and a filter against 256×256 taps",
        .note = "PSNR penumbra " + report::fixed(drawing.psnr_pcss, 2) + " dB",
        .body = report::picture_slider(figure("8×8", drawing.visibility), figure("256×256", bench.pcss()))},
       {.title = "8×8 taps and a filter against the truth",
        .note = "PSNR penumbra " + report::fixed(drawing.psnr_truth, 2) + " dB",
        .body = report::picture_slider(figure("8×8", drawing.visibility), figure("truth", bench.truth()))}});
  finding.body.add(
      crop_tiles(bench, {{"256×256 taps", many.config}, {"8×8 taps and a filter", few.config}}, noisiest_crop(bench)));
  finding.body.add(quality_table(finding, bench, {many, few}));
  finding.record({"the cost of 256×256 taps", costs[0], "ms", 1});
  finding.record({"the cost of 8×8 taps with a filter", costs[1], "ms", 1});
  finding.expect_at_least({"the cost of 256×256 taps over that of 8×8 taps with a filter", costs[0] / costs[1], "", 1},
                          order_of_magnitude);
  finding.expect_at_least(psnr_of(few, drawing), alike);
  finding.expect_at_least({"the growth of penumbra widths", 100 * drawing.width_bias, "%", 2}, 0.01);
  return finding;
}

Finding figure_4_13(Workbench& bench) {
  constexpr double linear = 0.98;
  const bench::Results results =
      bench::measure(sweep_options(bench.options()), image::image_decoder(cli::limits_of(bench.options().reading)),
                     shadow::built_in_registry());
  const bench::Model& model = results.models.front();
  Finding finding;
  finding.id = "4.13";
  finding.title = "Cost of blocker and filter taps";
  finding.claim =
      "Cost grows linearly with the number of taps; fewer than 8×8 are needed to stay below a millisecond, at 1280×720 "
      "on a GeForce RTX 2080 Ti.";
  finding.test =
      "8, 32, 64 and 128 taps of both steps, with a plane fitted through the 16 costs by least squares: it must "
      "explain 0.98 of their variance. Timed is the shadow mask's pass at this page's size, early exits off: its "
      "median, where the thesis has the mean frame time of 400 frames. Milliseconds are this machine's, so the second "
      "part of the claim is not judged.";
  for (const bench::Measured& measured : results.points) {
    finding.record({fmt::format("the cost of {}×{} taps", measured.point.names[0], measured.point.names[1]),
                    measured.costs.front().swept.median, "ms", 2});
  }
  finding.record({"the cost without taps", model.fit.constant, "ms", 3});
  finding.record({"the cost of a blocker tap", model.fit.slopes[0], "ms", 4});
  finding.record({"the cost of a filter tap", model.fit.slopes[1], "ms", 4});
  finding.body = heat_map(results);
  finding.body.add(report::paragraph(
      fmt::format("{}, R² = {}.", bench::equation_of(model, results.sweep), report::fixed(model.fit.r_squared, 4))));
  finding.expect_at_least({"the share of the costs' variance that a linear model explains", model.fit.r_squared, "", 4},
                          linear);
  return finding;
}

}  // namespace penumbra::reproduce
