#include "app/truth/options.h"

#include <CLI/CLI.hpp>
#include <vector>

namespace penumbra::app {

void add_truth_options(CLI::App& app, TruthOptions& o) {
  using cli::add_value;
  cli::add_scene_option(app, o);
  app.add_option(
         "-o,--output", o.output,
         "File to write: .exr (layers shadow, standard_error, hard, receiver; of a second light shadow_2, ...) or .png "
         "(shadow alone, 8 bits; of a second light FILE.shadow_2.png, ...)")
      ->required()
      ->type_name("FILE");
  add_value(app, "--spp", "N", "Rays of each pixel; short for --set truth.samples=N (256)",
            [&o](const auto& text) { o.samples = text; });
  add_value(app, "--error", "E", "Standard error to reach in 99.9 % of pixels; short for --set truth.error=E",
            [&o](const auto& text) { o.error = text; });
  add_value(app, "--seed", "N", "Seed of the sample points; short for --set truth.seed=N",
            [&o](const auto& text) { o.seed = text; });
  cli::add_size_option(app, o);
  cli::add_view_options(app, o);
  cli::add_time_options(app, o);
  cli::add_shadow_options(app, o);
  session::add_cache_options(app, o);
  app.add_flag("--quiet,-q", o.quiet, "No progress and no summary")->disable_flag_override();
  cli::add_device_options(app, o);
}

void check_together(const TruthOptions& options) {
  cli::check_together(static_cast<const cli::SceneOptions&>(options));
  cli::check_together(static_cast<const cli::DeviceOptions&>(options));
  check_together(static_cast<const session::CacheOptions&>(options));
}

ParamSet params_of(const TruthOptions& options, const shadow::Registry& registry) {
  auto all = static_cast<const cli::ShadowOptions&>(options);
  cli::refuse_technique(all.assignments, "what is written is the ray-traced truth; see penumbra render");
  all.technique = "truth";
  std::vector<std::string> assignments;
  const auto add = [&](const char* name, const std::optional<std::string>& text) {
    if (text) assignments.push_back(fmt::format("{}={}", name, *text));
  };
  add("truth.samples", options.samples);
  add("truth.error", options.error);
  add("truth.seed", options.seed);
  all.assignments.insert(all.assignments.begin(), assignments.begin(), assignments.end());
  return cli::resolve_params(all, registry);
}

}  // namespace penumbra::app
