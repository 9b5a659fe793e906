#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/results.h"
#include "cli/text.h"

namespace penumbra::bench {

namespace {

std::string pass_lines(const Cost& cost) {
  const auto line = [](const std::string& name, const Summary& ms, double share, const std::string& note = {}) {
    return fmt::format("  {:<22}{:>10.3f}{:>10.3f}{:>10.3f}{:>8.1f} %{}\n", name, ms.median, ms.min, ms.max,
                       100 * share, note);
  };
  std::string text =
      fmt::format("{:<24}{:>10}{:>10}{:>10}{:>10}\n", cli::printable(cost.label), "median ms", "min", "max", "share");
  for (const PassCost& pass : cost.passes) text += line(pass.name, pass.ms, pass.share, drawn_in(pass, cost));
  if (cost.has_passes()) text += line("sum of passes", cost.passes_sum, cost.sum_ratio);
  text += line("frame", cost.frame, 1);
  text += line("CPU", cost.cpu, cost.frame.median > 0 ? cost.cpu.median / cost.frame.median : 0);
  if (cost.has_passes() && !cost.adds_up())
    text += fmt::format("  warning: the passes make up {:.0f} % of the frame: a time is missing or counted twice\n",
                        100 * cost.sum_ratio);
  return text + "\n";
}

std::string floor_cells(const FloorCost& floor) {
  const std::string fetch = floor.fetch ? fmt::format("{:.3f}", floor.fetch->median) : "-";
  const std::string ratio = floor.mask_ratio ? fmt::format("{:.2f}", *floor.mask_ratio) : "-";
  return fmt::format("{:>13}{:>13}{:>13.3f}", fetch, ratio, floor.copy.median);
}

std::string summary_lines(const Measured& point) {
  const bool passes = point.costs.front().has_passes();
  std::string text = fmt::format("{:<24}{:>16}{:>12}{:>12}{:>12}", passes ? "shadow passes" : "whole frames",
                                 "median ms", "of first", "CPU ms", "memory");
  if (has_floor(point)) text += fmt::format("{:>13}{:>13}{:>13}", "fetches ms", "mask/fetches", "mask copy ms");
  text += "\n";
  for (const Cost& cost : point.costs) {
    text += fmt::format("{:<24}{:>16.3f}{:>12.3f}{:>12.3f}{:>12}", cli::printable(cost.label),
                        (passes ? cost.shadow : cost.frame).median, cost.of_first, cost.cpu.median,
                        cli::bytes_text(static_cast<double>(cost.shadow_bytes)));
    if (cost.floor) text += floor_cells(*cost.floor);
    text += "\n";
  }
  return text;
}

// One line a point: its place, and the shadow passes of each entry.
std::string sweep_lines(const Results& results) {
  std::string text;
  for (const Axis& axis : results.sweep.axes)
    text += fmt::format("{:>18}", axis.of_names.empty() ? axis.name : axis.of_names);
  for (const Entry& entry : results.entries) text += fmt::format("{:>24}", cli::printable(entry.label) + " ms");
  text += "\n";
  for (const Measured& point : results.points) {
    for (const std::string& name : point.point.names) text += fmt::format("{:>18}", name);
    for (const Cost& cost : point.costs) text += fmt::format("{:>24.3f}", cost.swept.median);
    text += "\n";
  }
  return text;
}

// "4 cascades of 2048×2048"; those that are fitted to the view may be fewer and larger.
std::string cascades_of(const Results& results) {
  const auto text_of = [](const Entry& entry) {
    const int count = entry.params.get_int("cascades.count"), side = entry.params.get_int("cascades.size");
    const bool fitted = entry.params.get_word("cascades.fit") != "stable";
    return fmt::format("{}{} cascade{} of {}×{}", fitted && count > 1 ? "the texels of " : "", count,
                       count == 1 ? "" : "s", side, side);
  };
  const std::string first = text_of(results.entries.front());
  const bool same = std::ranges::all_of(results.entries, [&](const Entry& entry) { return text_of(entry) == first; });
  return same ? first : "cascades as cascades.count and cascades.size say of each";
}

}  // namespace

std::string maps_of(const ParamSet& params) {
  return params.get_bool("maps.keep") ? "kept where nothing moved" : "drawn anew in every frame";
}

std::string maps_of(std::span<const ParamSet* const> of_all) {
  const std::string first = maps_of(*of_all.front());
  const bool same = std::ranges::all_of(of_all, [&](const ParamSet* params) { return maps_of(*params) == first; });
  return same ? first : "kept or drawn anew as maps.keep says of each";
}

std::string maps_of(const Results& results) {
  std::vector<const ParamSet*> params;
  for (const Entry& entry : results.entries) params.push_back(&entry.params);
  return maps_of(params);
}

std::string setting_of(const Results& results) {
  const auto swept = [&results](const char* name) { return results.sweep.name == name; };
  std::string text = cli::printable(results.scene);
  if (!swept("resolution")) {
    const cli::Size& size = results.points.front().size;
    text += fmt::format(", {}×{}", size.width, size.height);
  }
  if (results.sun && !swept("cascades") && !swept("map_size")) text += ", " + cascades_of(results);
  text += ", maps " + maps_of(results);
  if (has_floor(results.points.front())) text += ", masks with details, of which every pixel is computed";
  return text;
}

bool has_floor(const Measured& point) {
  return std::ranges::any_of(point.costs, [](const Cost& cost) { return cost.floor.has_value(); });
}

std::string drawn_in(const PassCost& pass, const Cost& cost) {
  if (pass.ms.count == cost.frame.count) return {};
  return fmt::format(", in {} of {} frames", pass.ms.count, cost.frame.count);
}

std::string subject_of(const Sweep& sweep) { return sweep.pass.empty() ? "shadow passes" : sweep.pass; }

std::string equation_of(const Model& model, const Sweep& sweep) {
  std::string text = fmt::format("ms = {:.4g}", model.fit.constant);
  for (std::size_t i = 0; i < sweep.axes.size(); ++i) {
    const double slope = model.fit.slopes[i];
    const std::string unit = sweep.axes[i].unit == "million" ? " (million)" : "";
    text += fmt::format(" {} {:.4g} · {}{}", slope < 0 ? "-" : "+", std::abs(slope), sweep.axes[i].name, unit);
  }
  return text;
}

std::string text_of(const Results& results) {
  std::string text = fmt::format("{}\n{}, {}\n{} frames after {}, {}\n\n", setting_of(results), results.device.renderer,
                                 results.machine.cpu, results.frames.measured, results.frames.warmup, results.timing);
  if (results.sweep.axes.empty()) {
    for (const Cost& cost : results.points.front().costs) text += pass_lines(cost);
    return text + summary_lines(results.points.front());
  }
  text += subject_of(results.sweep) + ", medians\n" + sweep_lines(results);
  for (const Model& model : results.models)
    text += fmt::format("\n{}: {}, R² {:.4f}\n", cli::printable(model.label), equation_of(model, results.sweep),
                        model.fit.r_squared);
  return text;
}

}  // namespace penumbra::bench
