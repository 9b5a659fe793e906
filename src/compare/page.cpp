#include "compare/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <variant>

#include "bench/machine.h"
#include "cli/text.h"
#include "compare/pictures.h"
#include "report/number.h"
#include "report/plot.h"
#include "report/table.h"
#include "report/text_blocks.h"
#include "truth/reference.h"

namespace penumbra::compare {

namespace {

using report::Best;
using report::Cell;
using report::Html;

constexpr double mebibyte = 1024.0 * 1024.0;

std::string reference_name(const Comparison& comparison) {
  const ParamSet& params = comparison.reference_params;
  if (params.get_word("technique") != "truth") return params.get_word("technique");
  return "the ray-traced truth, " + truth::rays_text(params);
}

std::vector<report::Column> columns_of(bool sequence) {
  std::vector<report::Column> columns{
      {"Technique", "", "As --technique names it."},
      {"Cost", "ms",
       "Median time of all passes between G-buffer and lighting; shadow maps are drawn anew in every frame, unless "
       "maps.keep was chosen.",
       Best::lowest},
      {"Memory", "MiB", "Shadow maps, masks, history and all other textures of the technique.", Best::lowest},
      {"PSNR penumbra", "dB", "Over receivers whose reference is between 0.02 and 0.98.", Best::highest},
      {"PSNR", "dB", "Over all receivers.", Best::highest},
      {"Bias", "visibility", "Mean signed error: above 0 where the shadow is too bright.", Best::nearest_zero},
      {"99th percentile", "visibility", "99 of 100 receivers are off by no more; the mean over lights and frames.",
       Best::lowest},
      {"SSIM", "", "Structural similarity, 1 where nothing differs.", Best::highest},
      {"FLIP", "", "How different the two look to a viewer who flips between them, 0 to 1.", Best::lowest},
      {"Width error", "%", "How much wider or narrower penumbrae are, on average.", Best::lowest},
      {"Width lost", "%",
       "Share of penumbra pixels where the shadow has no edge to measure; the width error leaves them out.",
       Best::lowest}};
  if (sequence) {
    columns.push_back({"Flicker", "visibility", "Mean change of the error from frame to frame.", Best::lowest});
    columns.push_back(
        {"Ghost", "visibility", "Mean error of pixels that were in shadow shortly before.", Best::lowest});
  }
  return columns;
}

Cell cell(double value, int decimals) {
  return report::cell_of(std::isnan(value) ? std::nullopt : std::optional(value), decimals);
}

std::vector<Cell> row_of(const ComparedTechnique& technique, bool sequence) {
  const ComparedFigures& f = technique.figures;
  std::vector<Cell> row{{technique.label},
                        cell(technique.cost.median, 1),
                        cell(static_cast<double>(technique.shadow_bytes) / mebibyte, 1),
                        cell(f.psnr_penumbra, 2),
                        cell(f.psnr, 2),
                        cell(f.bias, 5),
                        cell(f.p99, 3),
                        cell(f.ssim, 4),
                        cell(f.flip, 4),
                        cell(100 * f.width_error, 1),
                        cell(100 * f.width_lost, 1)};
  if (sequence) {
    row.push_back(cell(f.sequence ? f.sequence->flicker : NAN, 4));
    row.push_back(cell(f.sequence ? f.sequence->ghost : NAN, 4));
  }
  return row;
}

Html table_of(const ComparedScene& scene, const Comparison& comparison, bool sequence) {
  const std::size_t lights = scene.lights.size();
  const std::string masks = lights > 1 ? fmt::format(" of the masks of {} lights", lights) : "";
  report::Table table{.caption = fmt::format("Measured against {} where the light can shine: {} of {} pixels{}{}.",
                                             reference_name(comparison), scene.receivers, scene.pixels, masks,
                                             sequence ? " of the last frame" : ""),
                      .columns = columns_of(sequence),
                      .rows = {}};
  for (const ComparedTechnique& technique : scene.techniques) table.rows.push_back(row_of(technique, sequence));
  Html html = report::to_html(table);
  for (const ComparedTechnique& technique : scene.techniques) {
    if (technique.figures.not_finite > 0) html.add(report::note(not_finite_text(technique) + "."));
  }
  return html;
}

Html plot_of(const ComparedScene& scene) {
  report::ScatterPlot plot{.title = "Cost of the shadow passes against the error in the penumbra, for each technique",
                           .x = {"Cost of the shadow passes", "ms", /* log= */ true},
                           .y = {"RMSE in the penumbra", "visibility", /* log= */ true},
                           .dots = {}};
  for (const ComparedTechnique& technique : scene.techniques) {
    plot.dots.push_back(
        {.label = technique.label,
         .tooltip = fmt::format("PSNR penumbra {} dB", report::fixed(technique.figures.psnr_penumbra, 2)),
         .at = {technique.cost.median, technique.figures.rmse_penumbra}});
  }
  return report::to_html(plot);
}

std::string figures_text(const ComparedTechnique& technique) {
  const double cost = technique.cost.median;
  return fmt::format("{}PSNR penumbra {} dB · bias {}",
                     std::isnan(cost) ? "" : fmt::format("{} ms · ", report::fixed(cost, 1)),
                     report::fixed(technique.figures.psnr_penumbra, 2), report::fixed(technique.figures.bias, 5));
}

// Below the pictures of the masks.
std::string masks_note(std::size_t lights, bool sequence) {
  return fmt::format(
      "White: all of {} is visible{}. {}", lights > 1 ? "a light" : "it",
      lights > 1 ? "; one light below the other" : "",
      sequence ? "The figures are of all frames, these pictures of the last." : "The figures are of these pictures.");
}

Html pictures_of(const ComparedScene& scene, const Comparison& comparison, bool sequence) {
  const std::string& reference = comparison.reference_params.get_word("technique");
  const float scale = error_scale(scene);
  const std::size_t lights = scene.lights.size();
  Html html;
  for (const ComparedTechnique& technique : scene.techniques) {
    const std::string& label = technique.label;
    const auto figure = [](const std::string& name, const char* what, const report::EncodedPicture& picture) {
      return report::Figure{.label = name, .alt = fmt::format("{} drawn by {}", what, name), .picture = picture};
    };
    html.add(report::heading(label));
    html.add(report::note(figures_text(technique)));
    html.add(report::tiles(
        {{.title = "Picture",
          .note = "The last frame, tone mapped.",
          .body = report::picture_slider(figure(label, "The scene", technique.pictures.display),
                                         figure(reference, "The scene", scene.reference.display))},
         {.title = lights > 1 ? "Visibility of the lights" : "Visibility of the light",
          .note = masks_note(lights, sequence),
          .body =
              report::picture_slider(figure(label, "The visible share of the light", technique.pictures.visibility),
                                     figure(reference, "The visible share of the light", scene.reference.visibility))},
         {.title = "Error", .note = {}, .body = report::error_map(error_map(technique.pictures, label, scale))}}));
  }
  return html;
}

std::vector<std::pair<std::string, std::string>> changed_params(const ParamSet& params) {
  std::vector<std::pair<std::string, std::string>> changed;
  for (const Param& param : params.rows()) {
    if (params.is_default(param.name)) continue;
    const std::string unit = param.unit.empty() ? "" : " " + param.unit;
    changed.emplace_back(param.name, to_text(params.value(param.name)) + unit);
  }
  return changed;
}

Html params_section(const Comparison& comparison) {
  Html html = report::note("Values that differ from the defaults; penumbra help NAME explains one.");
  const auto add = [&html](const std::string& title, const ParamSet& params) {
    const auto changed = changed_params(params);
    html.add(report::heading(title));
    html.add(changed.empty() ? report::note("All defaults.") : report::definition_list(changed));
  };
  for (const ComparedTechnique& technique : comparison.scenes.front().techniques)
    add(technique.label, *technique.params);
  add("Reference: " + reference_name(comparison), comparison.reference_params);
  return html;
}

std::string point_text(const glm::vec3& v) { return fmt::format("{:.6g},{:.6g},{:.6g}", v.x, v.y, v.z); }

std::string light_text(const render::SunLight& light) {
  const render::Angles sun = render::angles_of(light.to_light);
  return fmt::format("--sun={:.6g},{:.6g}", sun.azimuth, sun.elevation);
}

std::string light_text(const render::LampLight& lamp) {
  return fmt::format("lamp of radius {:.6g} m at {}", lamp.radius, point_text(lamp.position));
}

// The view as command-line options, so that it can be drawn again even if the file's camera or sun changes.
std::string view_text(const ComparedScene& scene) {
  const render::Camera& camera = scene.camera;
  const std::string lens = camera.orthographic ? fmt::format("orthographic, half height {:g} m", camera.half_height)
                                               : fmt::format("--fov={:.6g}", glm::degrees(camera.fov_y));
  std::string text =
      fmt::format("--eye={} --target={} {}", point_text(render::position_of(camera)), point_text(scene.target), lens);
  for (const render::FrameLight& light : scene.lights)
    text += " " + std::visit([](const auto& kind) { return light_text(kind); }, light);
  return text;
}

Html command_section(const Comparison& comparison, const cli::Arguments& arguments) {
  // For a POSIX shell.
  Html html = report::code_block(cli::command_text("penumbra compare", arguments));
  std::vector<std::pair<std::string, std::string>> views;
  for (std::size_t i = 0; i < comparison.scenes.size(); ++i)
    views.emplace_back("View and lights of " + comparison.names[i], view_text(comparison.scenes[i]));
  return html.add(report::definition_list(views));
}

std::string frames_text(const CompareOptions& options) {
  if (!options.frames) return "a single picture";
  if (options.frames->count() == 1) return fmt::format("frame {}", options.frames->first);
  std::string text = fmt::format("{} frames, {:g} a second", options.frames->count(), options.fps);
  if (options.orbit) text += fmt::format(", orbit of {:g}° a frame with a cut", *options.orbit);
  return text;
}

bool has_sun(const ComparedScene& scene) {
  return std::ranges::any_of(
      scene.lights, [](const render::FrameLight& light) { return std::holds_alternative<render::SunLight>(light); });
}

std::vector<std::pair<std::string, std::string>> facts_of(const Comparison& comparison, const CompareOptions& options) {
  const ParamSet& params = comparison.reference_params;
  std::vector<std::pair<std::string, std::string>> facts{
      {"Size", fmt::format("{} × {}", options.size.width, options.size.height)}, {"Drawn", frames_text(options)}};
  if (std::ranges::any_of(comparison.scenes, has_sun))
    facts.emplace_back("Sun", fmt::format("{:g}° {}", params.get_float("sun.angle"), params.get_word("sun.shape")));
  facts.emplace_back("Device", comparison.drawn_by.device.at("renderer").get<std::string>());
  return facts;
}

std::string count_of(std::size_t count, const char* one, const char* many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

}  // namespace

void add_scene(Comparison& comparison, const CompareOptions& options, ComparedScene scene) {
  Html body = table_of(scene, comparison, options.frames.has_value());
  if (!options.no_cost) {
    body.add(report::heading("Cost against error"));
    body.add(plot_of(scene));
    body.add(
        report::note("Lower and further left is better. The steps join the techniques that no other one beats in both "
                     "cost and error."));
  }
  body.add(pictures_of(scene, comparison, options.frames.has_value()));
  comparison.sections.push_back({.title = comparison.names[comparison.scenes.size()], .body = std::move(body)});
  scene.reference = {};
  for (ComparedTechnique& technique : scene.techniques) technique.pictures = {};
  comparison.scenes.push_back(std::move(scene));
}

report::Page comparison_page(Comparison& comparison, const CompareOptions& options, const cli::Arguments& arguments) {
  report::Page page{
      .title = fmt::format("Shadow techniques on {}", fmt::join(comparison.names, ", ")),
      .summary = fmt::format("{} measured against {}.", count_of(options.contenders.size(), "technique", "techniques"),
                             reference_name(comparison)),
      .facts = facts_of(comparison, options),
      .sections = std::move(comparison.sections),
      .footer = fmt::format("{}, commit {}.{}", cli::version(), bench::commit(),
                            options.no_cost ? ""
                                            : " Costs are valid for this device and run only: compare them only "
                                              "with each other.")};
  page.sections.push_back({.title = "Command", .body = command_section(comparison, arguments)});
  page.sections.push_back({.title = "Parameters", .body = params_section(comparison)});
  return page;
}

}  // namespace penumbra::compare
