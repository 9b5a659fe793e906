#include "app/render/options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <string_view>

#include "cli/no_effect.h"
#include "cli/output_names.h"
#include "core/log.h"
#include "io/output_file.h"
#include "render/renderer.h"
#include "session/techniques.h"

namespace penumbra::app {

namespace {

// Where --save-preset writes. A file's name must end in .toml, so that no file of another kind is replaced by a slip;
// pipes and devices have any name.
std::string preset_output(const std::string& text) {
  std::string output = cli::text_output(text);
  if (text == "-") return output;
  const std::filesystem::path path = output;
  std::error_code error;
  const bool is_file = std::filesystem::is_regular_file(path, error) || !std::filesystem::exists(path, error);
  if (is_file && path.extension() != ".toml")
    cli::fail_usage("--save-preset {}: the name of a preset file ends in .toml", io::quoted(path));
  return output;
}

using cli::add_value;

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(' '), end = text.find_last_not_of(' ');
  return begin == std::string::npos ? "" : text.substr(begin, end - begin + 1);
}

void add_aovs(std::vector<std::string>& list, const std::string& text) {
  std::vector<std::string> names;
  for (const render::Aov& aov : render::aovs()) names.push_back(aov.name);
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string name = cli::one_of("AOV", trimmed(text.substr(begin, end - begin)), names);
    if (std::find(list.begin(), list.end(), name) == list.end()) list.push_back(name);
    begin = end + 1;
  }
}

void add_frame_option(CLI::App& app, RenderOptions& o) {
  add_value(app, "--frame", "N", "One frame of a sequence, whose file has the name of -o without a number",
            [&o](const auto& text) {
              const int frame = cli::parse_count("--frame", text, 0, 999'999);
              o.frame = frame;
              o.frames = cli::FrameRange{frame, frame};
            });
  app.get_option("--frame")->excludes(app.get_option("--frames"));
}

void add_output_options(CLI::App& app, RenderOptions& o) {
  app.add_option("-o,--output", o.output,
                 "Picture to write: .png (8-bit sRGB) or .exr (linear float); missing folders are made")
      ->required()
      ->type_name("FILE");
  add_value(app, "--aov", "NAME,...",
            "Other pictures of the frame: layers of an EXR, or a PNG each; see penumbra list aovs",
            [&o](const auto& text) { add_aovs(o.aovs, text); });
  add_value(app, "--aov-samples", "first|all",
            "What AOVs show of each pixel: its first sample, or the mean of all where that means something (first)",
            [&o](const auto& text) {
              static const std::vector<std::string> choices{"first", "all"};
              o.average_aovs = cli::one_of("choice of --aov-samples", text, choices) == "all";
            });
  add_value(app, "--stats", "FILE",
            "Write the cost of each pass and facts about the frame as JSON; -: to standard output",
            [&o](const auto& text) { o.stats = cli::text_output(text); });
  add_value(app, "--stats-frames", "N", "Frames to measure, after one that compiles shaders (1)",
            [&o](const auto& text) { o.stats_frames = cli::parse_count("--stats-frames", text, 1, 10000); });
  add_value(app, "--save-preset", "FILE.toml",
            "Write this picture's parameters as a preset file; -: to standard output",
            [&o](const auto& text) { o.save_preset = preset_output(text); });
  add_value(app, "--warmup", "N", "Frames drawn, but not written, before the first, for techniques with a history (0)",
            [&o](const auto& text) { o.warmup = cli::parse_count("--warmup", text, 0, 10000); });
  app.add_flag("--warmup-still", o.warmup_still,
               "Draw all warm-up frames at the first frame's time, so that nothing moves before it")
      ->disable_flag_override();
  app.add_flag("--quiet,-q", o.quiet, "No progress and no summary")->disable_flag_override();
}

}  // namespace

void add_render_options(CLI::App& app, RenderOptions& options) {
  cli::add_scene_option(app, options);
  add_output_options(app, options);
  cli::add_size_option(app, options);
  cli::add_supersample_option(app, options);
  cli::add_samples_option(app, options);
  cli::add_sample_shadows_option(app, options);
  cli::add_view_options(app, options);
  cli::add_time_options(app, options);
  add_frame_option(app, options);
  cli::add_technique_option(app, options);
  cli::add_shadow_options(app, options);
  session::add_cache_options(app, options);
  cli::add_device_options(app, options);
}

ParamSet params_of(const RenderOptions& options) {
  auto shadows = static_cast<const cli::ShadowOptions&>(options);
  shadows.otherwise = session::usual_technique;
  if (!options.frames && !cli::names_technique(options, session::all_techniques())) {
    // In the first place, so that the user's own values count. Who asks for two layers gets them.
    const bool names_layers = std::ranges::any_of(
        options.assignments, [](const std::string& assignment) { return assignment.starts_with("maps.layers="); });
    if (!names_layers) shadows.assignments.insert(shadows.assignments.begin(), {"maps.layers=2", "maps.overlap=0.05"});
    shadows.assignments.insert(shadows.assignments.begin(), "cascades.fit=penumbrae");
  }
  return cli::resolve_params(shadows, session::all_techniques());
}

void warn_without_effect(const RenderOptions& o, const ParamSet& params) {
  cli::warn_without_effect(o, {&params, 1}, session::all_techniques());
  cli::warn_of_rate(o);
  constexpr std::string_view one_sample = "each pixel has one sample";
  const bool asks_for_jitter = std::ranges::any_of(
      o.assignments, [](const std::string& assignment) { return assignment.starts_with("maps.jitter="); });
  const bool has_history = o.frames && session::earlier_frames_matter(params) == "history.reuse";
  const bool may_move = params.get_bool("maps.jitter") &&
                        cli::why_without_effect("maps.jitter", params, session::all_techniques()).empty();
  if (asks_for_jitter && may_move && !has_history && !o.own_shadows)
    warn("maps.jitter has no effect here: there is neither a history nor --sample-shadows");
  if (o.own_shadows && o.samples == 1) warn("--sample-shadows has no effect here: {}", one_sample);
  if (!o.average_aovs) return;
  const bool has_means = std::ranges::any_of(render::aovs(), [&](const render::Aov& aov) {
    return aov.reduction != render::Reduction::nearest_center && std::ranges::find(o.aovs, aov.name) != o.aovs.end();
  });
  if (o.samples == 1) {
    warn("--aov-samples has no effect here: {}", one_sample);
  } else if (!has_means) {
    warn("--aov-samples has no effect here: none of these AOVs has a mean");
  }
}

void check_together(const RenderOptions& o) {
  cli::check_together(static_cast<const cli::SceneOptions&>(o));
  cli::check_together(static_cast<const cli::DeviceOptions&>(o));
  check_together(static_cast<const session::CacheOptions&>(o));
  if (o.average_aovs && o.aovs.empty()) cli::fail_usage("--aov-samples needs --aov");
  if (o.warmup_still && o.warmup == 0) cli::fail_usage("--warmup-still needs --warmup");
  if (o.stats_frames > 1 && o.is_sequence())
    cli::fail_usage("--stats measures each frame of a sequence: leave out --stats-frames");
  if (o.stats_frames > 1 && o.stats.empty()) cli::fail_usage("--stats-frames needs --stats");
}

}  // namespace penumbra::app
