#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "bench/results.h"
#include "report/number.h"
#include "report/page.h"
#include "report/plot.h"
#include "report/table.h"
#include "report/text_blocks.h"

namespace penumbra::bench {

namespace {

using report::Best;
using report::Cell;
using report::cell_of;
using report::Html;

constexpr int decimals = 3;  // of milliseconds

constexpr const char* cpu_help =
    "Median processor time of the drawing thread in a frame, program and driver, without waiting for the GPU";

Cell milliseconds(double value) { return cell_of(value, decimals); }

std::string megabytes(std::size_t bytes) { return report::fixed(static_cast<double>(bytes) / (1 << 20), 1); }

// ---- One point ----

report::Table overview(const Measured& point) {
  const bool passes = point.costs.front().has_passes();
  const std::string timed = passes ? "shadow passes" : "whole frames";
  report::Table table{.caption = fmt::format("The {} of each technique, which took turns frame by frame", timed),
                      .columns = {{.title = "technique"},
                                  {.title = timed, .unit = "ms", .help = "Median", .best = Best::lowest},
                                  {.title = "of the first", .help = "Median of the ratios of single frames"},
                                  {.title = "frame", .unit = "ms", .help = "Median"},
                                  {.title = "CPU", .unit = "ms", .help = cpu_help},
                                  {.title = "memory",
                                   .unit = "MiB",
                                   .help = "Shadow maps, masks, history and all other textures of the technique"}}};
  const bool floor = has_floor(point);
  if (floor) {
    table.columns.push_back({.title = "fetches alone", .unit = "ms", .help = "As many, from the same discs and map"});
    table.columns.push_back({.title = "mask over fetches",
                             .help = "How near the mask's pass is to the machine's limit: 1 is at the limit",
                             .best = Best::lowest});
    table.columns.push_back(
        {.title = "mask copy", .unit = "ms", .help = "One read and one write of the mask with its details"});
  }
  for (const Cost& cost : point.costs) {
    std::vector<Cell> row{{cost.label},
                          milliseconds((passes ? cost.shadow : cost.frame).median),
                          milliseconds(cost.of_first),
                          milliseconds(cost.frame.median),
                          milliseconds(cost.cpu.median),
                          {megabytes(cost.shadow_bytes), static_cast<double>(cost.shadow_bytes)}};
    if (floor) {
      const auto fetch = cost.floor->fetch ? std::optional(cost.floor->fetch->median) : std::nullopt;
      row.push_back(cell_of(fetch, decimals));
      row.push_back(cell_of(cost.floor->mask_ratio, 2));
      row.push_back(milliseconds(cost.floor->copy.median));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

Html passes(const Cost& cost) {
  report::Table table{.caption = cost.label,
                      .columns = {{.title = "pass"},
                                  {.title = "median", .unit = "ms"},
                                  {.title = "min", .unit = "ms"},
                                  {.title = "max", .unit = "ms"},
                                  {.title = "share", .unit = "% of the frame"}}};
  const auto row = [&table](const std::string& name, const Summary& ms, double share) {
    table.rows.push_back(
        {{name}, milliseconds(ms.median), milliseconds(ms.min), milliseconds(ms.max), cell_of(100 * share, 1)});
  };
  for (const PassCost& pass : cost.passes) row(pass.name + drawn_in(pass, cost), pass.ms, pass.share);
  if (cost.has_passes()) row("sum of passes", cost.passes_sum, cost.sum_ratio);
  row("frame", cost.frame, 1);
  row("CPU", cost.cpu, cost.frame.median > 0 ? cost.cpu.median / cost.frame.median : 0);
  Html html = to_html(table);
  if (cost.has_passes() && !cost.adds_up()) {
    html.add(report::note(
        fmt::format("Warning: the passes make up {:.0f} % of the frame: a time is missing or counted twice.",
                    100 * cost.sum_ratio)));
  }
  return html;
}

// The passes of each technique's frame, one bar for each. Empty where passes were not timed.
Html pass_bars(const Measured& point) {
  report::BarPlot plot{.title =
                           "What each technique's frame is made of: medians of its passes, less where not all frames "
                           "drew them",
                       .x = {.label = "time of the passes", .unit = "ms"},
                       .parts = {},
                       .bars = {}};
  for (const Cost& cost : point.costs) {
    for (const PassCost& pass : cost.passes) {
      const bool outer = pass.name.find('/') == std::string::npos;
      if (outer && std::ranges::find(plot.parts, pass.name) == plot.parts.end()) plot.parts.push_back(pass.name);
    }
  }
  if (plot.parts.empty()) return {};
  for (const Cost& cost : point.costs) {
    report::Bar bar{.label = cost.label, .values = std::vector<double>(plot.parts.size(), 0.0)};
    for (const PassCost& pass : cost.passes) {
      const auto part = std::ranges::find(plot.parts, pass.name);
      if (part != plot.parts.end())
        bar.values[static_cast<std::size_t>(part - plot.parts.begin())] = cost.per_frame(pass);
    }
    plot.bars.push_back(std::move(bar));
  }
  return to_html(plot);
}

// ---- Sweeps ----

// "blocker_taps", the key of files, in words.
std::string in_words(std::string name) {
  std::ranges::replace(name, '_', ' ');
  return name;
}

std::vector<std::string> names_along(const Results& results, std::size_t axis) {
  std::vector<std::string> names;
  for (const Measured& point : results.points) {
    const std::string& name = point.point.names[axis];
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  }
  return names;
}

// Of two axes, points row by row.
Html heat_map(const Results& results, std::size_t entry) {
  report::HeatMap map{
      .caption = fmt::format("{}: {}, medians", results.entries[entry].label, subject_of(results.sweep)),
      .row_title = in_words(results.sweep.axes[0].name),
      .column_title = in_words(results.sweep.axes[1].name),
      .row_names = names_along(results, 0),
      .column_names = names_along(results, 1),
      .values = {},
      .unit = "ms"};
  for (const Measured& point : results.points) map.values.push_back(point.costs[entry].swept.median);
  return to_html(map);
}

Html line_plot(const Results& results) {
  const Axis& axis = results.sweep.axes.front();
  report::LinePlot plot{.title = subject_of(results.sweep) + " over " + in_words(axis.name),
                        .x = {.label = in_words(axis.name), .unit = axis.unit, .log = axis.log},
                        .y = {.label = subject_of(results.sweep), .unit = "ms", .log = axis.log},
                        .lines = {}};
  for (std::size_t i = 0; i < results.entries.size(); ++i) {
    report::Line line{.label = results.entries[i].label, .points = {}};
    for (const Measured& point : results.points)
      line.points.push_back({point.point.at.front(), point.costs[i].swept.median});
    plot.lines.push_back(std::move(line));
  }
  return to_html(plot);
}

report::Table sweep_table(const Results& results) {
  report::Table table{.caption = subject_of(results.sweep) + " at each point, medians",
                      .columns = {{.title = "point"}}};
  for (const Axis& axis : results.sweep.axes)
    table.columns.push_back({.title = in_words(axis.name), .unit = axis.unit});
  for (const Entry& entry : results.entries) table.columns.push_back({.title = entry.label, .unit = "ms"});
  for (const Measured& point : results.points) {
    std::vector<Cell> row{{fmt::format("{}", fmt::join(point.point.names, " × "))}};
    for (const double at : point.point.at) row.push_back({report::significant(at, 6), at});
    for (const Cost& cost : point.costs) row.push_back(milliseconds(cost.swept.median));
    table.rows.push_back(std::move(row));
  }
  return table;
}

Html models(const Results& results) {
  Html html;
  for (const Model& model : results.models) {
    html.add(report::paragraph(
        fmt::format("{}: {}, with R² = {:.4f}.", model.label, equation_of(model, results.sweep), model.fit.r_squared)));
  }
  return html.add(
      report::note("Least squares over all points. R² is the share of the variance that the model explains."));
}

std::vector<report::Section> sweep_sections(const Results& results) {
  Html shown;
  if (results.sweep.axes.size() == 2) {
    for (std::size_t i = 0; i < results.entries.size(); ++i) shown.add(heat_map(results, i));
  } else {
    shown.add(line_plot(results));
  }
  std::vector<report::Section> sections{{"Cost over " + in_words(results.sweep.name), std::move(shown)}};
  if (!results.models.empty()) sections.push_back({"Cost model", models(results)});
  sections.push_back({"All points", to_html(sweep_table(results))});
  return sections;
}

// ---- How ----

Html parameters(const Entry& entry) {
  std::vector<std::pair<std::string, std::string>> values;
  for (const Param& row : entry.params.rows()) values.emplace_back(row.name, to_text(entry.params.value(row.name)));
  return report::details(entry.label, report::definition_list(values));
}

report::Section how(const Results& results) {
  Html html = report::code_block(results.command);
  for (const Entry& entry : results.entries) html.add(parameters(entry));
  return {"Command and parameters", std::move(html)};
}

}  // namespace

std::string html_of(const Results& results) {
  report::Page page{
      .title = results.sweep.name.empty() ? "What a frame costs" : "Cost over " + in_words(results.sweep.name),
      .summary = setting_of(results) + ". Compare by ratio within this run, not with times of another.",
      .facts = {{"device", results.device.renderer},
                {"driver", results.device.version},
                {"processor", fmt::format("{}, {} cores", results.machine.cpu, results.machine.cores)},
                {"frames", fmt::format("{} after {} of warm-up", results.frames.measured, results.frames.warmup)},
                {"timing", results.timing},
                {"commit", results.commit}},
      .sections = {},
      .footer = results.version};
  if (results.sweep.axes.empty()) {
    Html costs;
    for (const Cost& cost : results.points.front().costs) costs.add(passes(cost));
    page.sections.push_back(
        {"Techniques", to_html(overview(results.points.front())).add(pass_bars(results.points.front()))});
    page.sections.push_back({"Passes", std::move(costs)});
  } else {
    page.sections = sweep_sections(results);
  }
  page.sections.push_back(how(results));
  return report::to_text(page);
}

}  // namespace penumbra::bench
