#include "compare/tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <limits>
#include <vector>

#include "bench/machine.h"
#include "bench/results.h"
#include "cli/command_line.h"
#include "cli/text.h"
#include "io/text.h"

namespace penumbra::compare {

namespace {

using io::Json;

// A figure by name, as CSV and JSON have it.
struct NamedFigure {
  const char* name;
  double value;
};

double sequence_value(const ComparedFigures& figures, double metrics::SequenceFigures::*member) {
  return figures.sequence ? (*figures.sequence).*member : std::numeric_limits<double>::quiet_NaN();
}

std::vector<NamedFigure> figures_of(const ComparedFigures& f) {
  return {{"psnr_penumbra", f.psnr_penumbra},
          {"psnr", f.psnr},
          {"rmse_penumbra", f.rmse_penumbra},
          {"rmse", f.rmse},
          {"bias", f.bias},
          {"max", f.max},
          {"p99", f.p99},
          {"ssim", f.ssim},
          {"flip", f.flip},
          {"penumbra_width_error", f.width_error},
          {"penumbra_width_lost", f.width_lost},
          {"flicker", sequence_value(f, &metrics::SequenceFigures::flicker)},
          {"ghost", sequence_value(f, &metrics::SequenceFigures::ghost)}};
}

std::vector<NamedFigure> costs_of(const ShadowCost& cost) {
  return {{"median_ms", cost.median}, {"min_ms", cost.min}, {"max_ms", cost.max}};
}

std::string csv_number(double value) {
  if (std::isnan(value)) return "";
  return std::isinf(value) ? (value > 0 ? "inf" : "-inf") : fmt::format("{:.6g}", value);
}

// Six digits; more are not meaningful.
Json rounded(double value) {
  return io::json_number(std::isfinite(value) ? std::stod(fmt::format("{:.6g}", value)) : value);
}

std::string fixed(double value, int decimals) {
  return std::isnan(value) ? "-" : fmt::format("{:.{}f}", value, decimals);
}

std::vector<std::string> terminal_row(const ComparedTechnique& technique) {
  const ComparedFigures& figures = technique.figures;
  return {cli::printable(technique.label),
          fixed(technique.cost.median, 1),
          cli::bytes_text(static_cast<double>(technique.shadow_bytes)),
          fixed(figures.psnr_penumbra, 2),
          fixed(figures.psnr, 2),
          std::isnan(figures.bias) ? "-" : fmt::format("{:+.4f}", figures.bias),
          fixed(figures.flip, 4),
          fixed(100 * figures.width_error, 1),
          fixed(100 * figures.width_lost, 1),
          fixed(sequence_value(figures, &metrics::SequenceFigures::flicker), 4)};
}

// `first`: the number of the sequence's first frame.
Json recoveries(const ComparedFigures& figures, std::size_t first) {
  Json list = Json::array();
  if (!figures.sequence) return list;
  for (const metrics::Recovery& recovery : figures.sequence->recoveries) {
    list.push_back({{"frame", first + recovery.frame},
                    {"recovery_frames", recovery.frames ? Json(*recovery.frames) : Json()},
                    {"static_error", rounded(recovery.static_error)}});
  }
  return list;
}

Json json_of(const ComparedTechnique& technique, std::size_t first_frame) {
  Json figures = Json::object(), cost;
  for (const NamedFigure& figure : figures_of(technique.figures)) figures[figure.name] = rounded(figure.value);
  figures["recoveries"] = recoveries(technique.figures, first_frame);
  figures["not_finite"] = technique.figures.not_finite;
  if (!std::isnan(technique.cost.median)) {
    for (const NamedFigure& figure : costs_of(technique.cost)) cost[figure.name] = rounded(figure.value);
    cost["frames"] = technique.cost.frames;
  }
  return {{"label", technique.label},
          {"technique", technique.params->get_word("technique")},
          {"changed_params", io::changed_params(*technique.params)},
          {"shadow_bytes", technique.shadow_bytes},
          {"figures", figures},
          {"cost", cost}};
}

Json json_of(const glm::vec3& v) {
  Json list = Json::array();
  for (int i = 0; i < 3; ++i) list.push_back(io::to_json(ParamValue(v[i])));
  return list;
}

Json camera_of(const ComparedScene& scene) {
  const render::Camera& camera = scene.camera;
  Json json = {{"eye", json_of(render::position_of(camera))}, {"target", json_of(scene.target)}};
  if (camera.orthographic)
    json["half_height"] = io::to_json(ParamValue(camera.half_height));
  else
    json["fov_y_degrees"] = rounded(glm::degrees(static_cast<double>(camera.fov_y)));
  return json;
}

// A compared light.
Json json_of(const render::SunLight& sun) {
  const render::Angles angles = render::angles_of(sun.to_light);
  return {{"kind", "sun"},
          {"to_light", json_of(sun.to_light)},
          {"azimuth_degrees", rounded(angles.azimuth)},
          {"elevation_degrees", rounded(angles.elevation)}};
}

Json json_of(const render::LampLight& lamp) {
  const bool spot = lamp.axis != glm::vec3(0);
  Json json{{"kind", spot ? "spot" : "point"},
            {"position", json_of(lamp.position)},
            {"radius", rounded(static_cast<double>(lamp.radius))}};
  if (!spot) return json;
  json["axis"] = json_of(lamp.axis);
  json["cone_half_angle_degrees"] = rounded(glm::degrees(static_cast<double>(lamp.outer_cone)));
  return json;
}

Json lights_of(const ComparedScene& scene) {
  Json lights = Json::array();
  for (const render::FrameLight& light : scene.lights)
    lights.push_back(std::visit([](const auto& kind) { return json_of(kind); }, light));
  return lights;
}

}  // namespace

std::string terminal_table(const ComparedScene& scene) {
  std::vector<std::vector<std::string>> rows{{"technique", "cost ms", "memory", "PSNR penumbra dB", "PSNR dB", "bias",
                                              "FLIP", "width %", "lost %", "flicker"}};
  for (const ComparedTechnique& technique : scene.techniques) rows.push_back(terminal_row(technique));
  std::vector<std::size_t> widths(rows.front().size(), 0);
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string text;
  for (const auto& row : rows) {
    text += fmt::format("{:<{}}", row[0], widths[0]);
    for (std::size_t i = 1; i < row.size(); ++i) text += fmt::format("  {:>{}}", row[i], widths[i]);
    text += "\n";
  }
  return text;
}

std::string csv_table(const Comparison& comparison) {
  std::string text = "scene,technique,reference,shadow_bytes";
  const ComparedTechnique empty;
  for (const NamedFigure& figure : figures_of(empty.figures)) text += fmt::format(",{}", figure.name);
  for (const NamedFigure& figure : costs_of(empty.cost)) text += fmt::format(",cost_{}", figure.name);
  text += ",cost_frames,not_finite\n";
  for (const ComparedScene& scene : comparison.scenes) {
    for (const ComparedTechnique& technique : scene.techniques) {
      text += fmt::format("{},{},{},{}", io::csv_field(scene.path), io::csv_field(technique.label),
                          comparison.reference_params.get_word("technique"), technique.shadow_bytes);
      for (const NamedFigure& figure : figures_of(technique.figures))
        text += fmt::format(",{}", csv_number(figure.value));
      for (const NamedFigure& figure : costs_of(technique.cost)) text += fmt::format(",{}", csv_number(figure.value));
      const bool timed = !std::isnan(technique.cost.median);
      text += fmt::format(",{},{}\n", timed ? std::to_string(technique.cost.frames) : "", technique.figures.not_finite);
    }
  }
  return text;
}

Json json_of(const Comparison& comparison, const CompareOptions& options, const cli::Arguments& arguments) {
  std::vector<const ParamSet*> params;
  for (const ComparedTechnique& technique : comparison.scenes.front().techniques) params.push_back(technique.params);
  const auto first_frame = static_cast<std::size_t>(options.frames ? options.frames->first : 0);
  Json scenes = Json::array();
  for (const ComparedScene& scene : comparison.scenes) {
    Json techniques = Json::array();
    for (const ComparedTechnique& technique : scene.techniques) techniques.push_back(json_of(technique, first_frame));
    Json json{{"scene", scene.path}, {"camera", camera_of(scene)}, {"lights", lights_of(scene)}};
    json["pixels"] = scene.pixels;
    json["receivers"] = scene.receivers;
    json["techniques"] = std::move(techniques);
    scenes.push_back(std::move(json));
  }
  return io::document("compare", 2,
                      {{"version", cli::version()},
                       {"commit", bench::commit()},
                       {"command", cli::command_text("penumbra compare", arguments)},
                       {"reference",
                        {{"technique", comparison.reference_params.get_word("technique")},
                         {"changed_params", io::changed_params(comparison.reference_params)}}},
                       {"width", options.size.width},
                       {"height", options.size.height},
                       {"frames", options.frames ? options.frames->count() : 1},
                       {"maps", bench::maps_of(params)},
                       {"backend", comparison.drawn_by.backend},
                       {"device", comparison.drawn_by.device},
                       {"scenes", std::move(scenes)}});
}

}  // namespace penumbra::compare
