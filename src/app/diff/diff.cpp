#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>

#include "app/commands.h"
#include "app/diff/figures.h"
#include "cli/input_files.h"
#include "cli/options.h"
#include "cli/output_names.h"
#include "cli/signals.h"
#include "cli/usage.h"
#include "image/picture.h"
#include "image/write.h"
#include "io/memory.h"
#include "io/output_file.h"
#include "io/report.h"
#include "metrics/heat_map.h"

namespace penumbra::app {

namespace {

struct DiffOptions {
  std::string test, reference, layer, mask, heatmap, json;
  std::string metric = "rmse";
  std::optional<double> max, min, heatmap_range;
  std::optional<int> max_pixels;
  bool quiet = false;
};

std::string description() {
  std::string text =
      "Measure how far picture A is from picture B, the reference. PNGs are compared by display values from 0 to 1, "
      "EXRs by their values as they are. A value of A that is not finite counts as an error of 1. If --max or --min is "
      "given, the exit code is 1 where the limit is exceeded or A has a value that is not finite.\n\nMetrics:\n";
  for (const Metric& metric : diff_metrics()) text += fmt::format("  {:<21} {}\n", metric.name, metric.help);
  return text +
         "psnr needs references from 0 to 1; ssim and flip need PNGs or single channels from 0 to 1; "
         "psnr_penumbra and penumbra_width_error need single channels from 0 to 1.";
}

void add_options(CLI::App& app, DiffOptions& options) {
  app.add_option("A", options.test, "Picture to test, .png or .exr")->required()->type_name("");
  app.add_option("B", options.reference, "Picture to compare with")->required()->type_name("");
  app.add_option("--metric", options.metric, "Metric of --max, --min and --heatmap")
      ->type_name("METRIC")
      ->capture_default_str();
  cli::add_value(app, "--max", "V", "Fail if the metric is greater",
                 [&](const std::string& text) { options.max = cli::parse_number("--max", text, 0, 1e9); });
  cli::add_value(app, "--min", "V", "Fail if psnr, psnr_penumbra or ssim is less",
                 [&](const std::string& text) { options.min = cli::parse_number("--min", text, -1e3, 1e3); });
  const auto add = [&app](const char* name, const char* type, const char* help, std::string& value) {
    cli::add_value(app, name, type, help, [&value](const std::string& text) { value = text; });
  };
  add("--layer", "NAME", "Layer of both EXRs (the one without a name, or else the only one)", options.layer);
  add("--mask", "NAME", "Layer of B with one channel: pixels that are 0 or not finite in it are left out",
      options.mask);
  add("--heatmap", "FILE", "PNG that shows where the pictures differ: FLIP for that metric, else |error|",
      options.heatmap);
  cli::add_value(
      app, "--heatmap-range", "V",
      "The error with the last colour of --heatmap, 0.0001 to 100000 (1 for FLIP; else the largest error, rounded up)",
      [&](const std::string& text) {
        options.heatmap_range =
            cli::parse_number("--heatmap-range", text, metrics::least_heat_scale, metrics::most_heat_scale);
      });
  cli::add_value(app, "--json", "FILE", "Write the figures as JSON; -: to standard output, instead of the line",
                 [&](const std::string& text) { options.json = cli::text_output(text); });
  cli::add_value(app, "--max-pixels", "N", "Refuse larger pictures before they are decoded (as many as memory holds)",
                 [&](const std::string& text) {
                   options.max_pixels = cli::parse_count("--max-pixels", text, 1, std::numeric_limits<int>::max());
                 });
  app.add_flag("--quiet,-q", options.quiet, "Print errors only")->disable_flag_override();
}

void check_together(const DiffOptions& options, const Metric& metric) {
  if (options.max && metric.higher_is_better)
    cli::fail_usage("--max can't limit {}, which is better when greater: use --min", metric.name);
  if (options.min && !metric.higher_is_better)
    cli::fail_usage("--min can't limit {}, which is better when less: use --max", metric.name);
  if (options.heatmap_range && options.heatmap.empty())
    cli::fail_usage("--heatmap-range is the range of --heatmap's colours, and there is no --heatmap");
  if (!options.heatmap.empty() && std::filesystem::path(options.heatmap).extension() != ".png")
    cli::fail_usage("--heatmap {}: the name does not end in .png", io::quoted(options.heatmap));
}

image::Picture read(const DiffOptions& options, const std::string& file, const std::string& layer) {
  constexpr std::size_t bytes_per_pixel = 128;  // of both pictures, the metrics' fields and the heat map
  const std::size_t most =
      options.max_pixels ? static_cast<std::size_t>(*options.max_pixels) : io::available_memory() / bytes_per_pixel;
  return image::read_picture(file, layer, most);
}

// Which pixels --mask selects; empty: all.
std::vector<std::uint8_t> receivers_of(const DiffOptions& options) {
  if (options.mask.empty()) return {};
  const image::Picture mask = read(options, options.reference, options.mask);
  if (mask.channels.size() != 1)
    fail("--mask {}: that layer of {} has {} channels, not 1", options.mask, io::quoted(options.reference),
         mask.channels.size());
  return selected_by(mask.pixels,
                     fmt::format("--mask {}: that layer of {}", options.mask, io::quoted(options.reference)));
}

// Called before measuring, which can take minutes. Throws if a result can't be written, or would overwrite another one
// or a picture that is compared.
void check_results(const DiffOptions& options) {
  cli::InputFiles inputs;
  for (const std::string& picture : {options.test, options.reference}) inputs.add("the picture", picture);
  for (const auto& [option, result] : {std::pair("--heatmap", options.heatmap), std::pair("--json", options.json)}) {
    if (result.empty()) continue;
    inputs.check(option, result);
    io::check_writable(result);
  }
  if (!options.json.empty() && !options.heatmap.empty() && io::would_replace(options.json, options.heatmap))
    cli::fail_usage("--heatmap and --json name the same file {}", io::quoted(options.json));
}

void write_heatmap(const DiffOptions& options, const Metric& metric, const Difference& difference,
                   const image::Picture& reference) {
  const bool flip = std::string_view(metric.name) == "flip";
  const std::vector<float>& errors = flip ? difference.flip_map : difference.errors;
  const float usual = flip ? 1.0f : metrics::heat_scale(*std::max_element(errors.begin(), errors.end()));
  const auto scale = static_cast<float>(options.heatmap_range.value_or(usual));
  image::write_png(options.heatmap, reference.width, reference.height + metrics::heat_legend_rows, 3,
                   metrics::heat_map(errors, reference.width, reference.height, scale),
                   {{"Software", cli::version()}, {"penumbra:full_scale", fmt::format("{:g}", scale)}});
}

// One line about a limit that is exceeded, or an empty text.
std::string verdict(const DiffOptions& options, const Figure& figure, const Difference& difference) {
  const std::string names = fmt::format("{} against {}", io::quoted(options.test), io::quoted(options.reference));
  if (!options.max && !options.min) return {};
  if (difference.not_finite > 0)
    return fmt::format("{}: {} values of the first picture are not finite", names, difference.not_finite);
  if (std::isnan(figure.value)) {
    if (!figure.metric->of_penumbrae)
      return fmt::format("{}: {} is not a number: values are too large", names, figure.metric->name);
    if (difference.width_lost > 0)
      return fmt::format("{}: no penumbra of the first picture has a width that can be measured", names);
    return fmt::format("{}: there is no penumbra to measure {} of", names, figure.metric->name);
  }
  const double value = options.max ? std::abs(figure.value) : figure.value;
  if (options.max && value > *options.max)
    return fmt::format("{}: {} is {}, over the limit of {:g}", names, figure.metric->name, text_of(figure),
                       *options.max);
  if (options.min && value < *options.min)
    return fmt::format("{}: {} is {}, under the limit of {:g}", names, figure.metric->name, text_of(figure),
                       *options.min);
  return {};
}

void write_json(const DiffOptions& options, const Figure& figure, const Difference& difference,
                const image::Picture& reference) {
  io::Json json{{"test", options.test},
                {"reference", options.reference},
                {"layer", reference.layer},
                {"mask", options.mask},
                {"width", reference.width},
                {"height", reference.height},
                {"channels", reference.channels},
                {"samples", difference.samples},
                {"penumbra_samples", difference.penumbra_samples},
                {"not_finite", difference.not_finite},
                {"figures", to_json(difference)}};
  if (options.max || options.min) {
    io::Json& limit = json["limit"] = {{"metric", figure.metric->name}};
    limit[options.max ? "max" : "min"] = options.max ? *options.max : *options.min;
    limit["kept"] = verdict(options, figure, difference).empty();
  }
  io::write_text(options.json, io::text_of(io::document("diff", 1, json)));
}

}  // namespace

int run_diff(const Arguments& arguments) {
  CLI::App app(description(), "penumbra diff");
  DiffOptions options;
  add_options(app, options);
  if (!cli::parse(app, arguments)) return 0;
  const Metric& metric = find_diff_metric(options.metric);
  check_together(options, metric);
  check_results(options);
  cli::clean_up_on_signals();

  const image::Picture test = read(options, options.test, options.layer);
  const image::Picture reference = read(options, options.reference, options.layer);
  const std::vector<std::uint8_t> receivers = receivers_of(options);
  check_comparable(test, reference, receivers, options.test, options.reference);
  const Difference difference = difference_of(test, reference, receivers);
  const Figure& figure = difference.figure(metric);
  const bool asked = options.max || options.min || !options.heatmap.empty();
  if (asked && !figure.unfit.empty())
    fail("{} can't be measured for {}: it {}", metric.name, io::quoted(options.reference), figure.unfit);

  if (!options.heatmap.empty()) write_heatmap(options, metric, difference, reference);
  if (!options.json.empty()) write_json(options, figure, difference, reference);
  const bool json_on_stdout = !options.json.empty() && io::would_replace(options.json, "/dev/stdout");
  if (!options.quiet && !json_on_stdout) fmt::print("{}\n", text_of(difference));
  const std::string fault = verdict(options, figure, difference);
  if (!fault.empty()) fail("{}", fault);
  return 0;
}

}  // namespace penumbra::app
