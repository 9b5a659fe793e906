#include "bench/options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>

#include "bench/floor.h"
#include "bench/sweep.h"
#include "cli/usage.h"
#include "io/output_file.h"
#include "io/presets.h"
#include "io/text.h"

namespace penumbra::bench {

namespace {

using cli::add_value;
using cli::fail_usage;

std::vector<std::string> names_of(std::string_view option, const std::string& text) {
  std::vector<std::string> names = io::split(text, ',');
  if (std::ranges::find(names, "") != names.end()) fail_usage("{} can't be '{}': a name in it is empty", option, text);
  return names;
}

void set_for_floor(ParamSet& params, const cli::ShadowOptions& options) {
  for (const auto& [name, value] : values_for_floor(params)) {
    if (params.value(name) != value && cli::is_chosen(options, params, name))
      fail_usage("--floor measures with {}={}, and can't with {}", name, to_text(value), to_text(params.value(name)));
    params.set(name, value);
  }
}

// Values of presets may be swept, those that are asked for here may not.
void refuse_swept(const Options& options, const ParamSet& params) {
  for (const std::string& name : swept_params(options.sweep, params)) {
    if (name == "sun.angle" && !options.sun_angle.empty())
      fail_usage("--sweep {} sets {}, so --sun-angle has no place beside it", options.sweep, name);
    for (const std::string& text : options.assignments) {
      if (text.starts_with(name + "="))
        fail_usage("--sweep {} sets {}, so --set {} has no place beside it", options.sweep, name, text);
    }
  }
}

bool is_preset(const std::string& name) { return std::filesystem::path(name).extension() == ".toml"; }

void add_output(Options& options, const std::string& name) {
  const std::string extension = std::filesystem::path(name).extension().string();
  if (extension != ".json" && extension != ".csv" && extension != ".html")
    fail_usage("-o '{}': the name ends in none of .json, .csv, .html", name);
  for (const std::string& other : options.outputs) {
    if (io::place_of(other) != io::place_of(name)) continue;
    if (other == name) fail_usage("-o '{}' is given twice", name);
    fail_usage("-o '{}' would replace the output '{}'", name, other);
  }
  options.outputs.push_back(name);
}

void add_bench_options(CLI::App& app, Options& o) {
  add_value(
      app, "--technique", "NAME,...",
      "Techniques, presets or preset files (.toml) to compare, in turn frame by frame; see penumbra list techniques "
      "(pcss)",
      [&o](const auto& text) { o.techniques = names_of("--technique", text); });
  add_value(app, "--frames", "N", "Frames to measure, for each technique and point (400; in software 20, of a sweep 4)",
            [&o](const auto& text) { o.frame_count = cli::parse_count("--frames", text, 1, 100000); });
  add_value(app, "--warmup", "N", "Frames before them that are not measured (20; in software 2)",
            [&o](const auto& text) { o.warmup = cli::parse_count("--warmup", text, 1, 100000); });
  for (const char* name : {"--frames", "--warmup"}) app.get_option(name)->group("Measurement");
  add_value(app, "--time", "S", "Time of the scene's animation, seconds",
            [&o](const auto& text) { o.time = cli::parse_number("--time", text, 0, 1e6); });
  app.add_flag("--play", o.play, "Play the animation, 60 frames per second, instead of one time of it")
      ->disable_flag_override();
  app.add_flag(
         "--floor", o.floor,
         "Also measure each technique's texture fetches alone, and one read and write of the mask, which then has "
         "details, and of which every pixel is computed by all fetches")
      ->disable_flag_override();
  app.add_flag("--whole-frames", o.whole_frames,
               "In software: finish each frame, not each pass, and time frames alone, as an application would")
      ->disable_flag_override();
  const std::string sweeps = fmt::format("Measure over a range of values: {}", fmt::join(sweep_names(), ", "));
  add_value(app, "--sweep", "NAME", sweeps.c_str(),
            [&o](const auto& text) { o.sweep = cli::one_of("sweep", text, sweep_names()); });
  app.add_option_function<std::vector<std::string>>(
         "-o,--output",
         [&o](const auto& names) {
           for (const std::string& name : names) add_output(o, name);
         },
         "File for the results: .json, .csv or .html; repeatable")
      ->type_name("FILE")
      ->allow_extra_args(false);
  app.add_flag("--quiet,-q", o.quiet, "No progress and no table")->disable_flag_override();
}

}  // namespace

void add_options(CLI::App& app, Options& options) {
  app.add_option("SCENE", options.scene, "glTF file, .gltf or .glb; a sweep of casters generates its scene")
      ->type_name("");
  add_bench_options(app, options);
  add_value(app, "--size", "WIDTHxHEIGHT", "Pixels (1280x720)",
            [&options](const auto& text) { options.size = cli::parse_size("--size", text); });
  cli::add_view_options(app, options);
  cli::add_shadow_options(app, options);
  cli::add_device_options(app, options);
}

void check_together(const Options& o) {
  cli::check_together(static_cast<const cli::SceneOptions&>(o));
  cli::check_together(static_cast<const cli::DeviceOptions&>(o));
  if (o.scene.empty() && o.sweep != "casters") fail_usage("SCENE is required");
  if (o.whole_frames && o.floor) fail_usage("--whole-frames times no passes, of which --floor is a bound");
  if (o.whole_frames && !o.sweep.empty()) fail_usage("--whole-frames times no passes, which --sweep measures");
  if (o.quiet && o.outputs.empty()) fail_usage("--quiet without -o would neither print nor write anything");
}

std::vector<Entry> entries_of(const Options& options, const shadow::Registry& registry) {
  std::vector<std::string> names = options.techniques;
  if (names.empty()) {
    names.emplace_back();  // what the presets say
  } else {
    cli::refuse_technique(options.assignments, "see --technique");
  }
  std::vector<Entry> entries;
  for (const std::string& name : names) {
    cli::ShadowOptions one = static_cast<const cli::ShadowOptions&>(options);
    if (is_preset(name)) {
      one.presets.push_back(name);
    } else {
      one.technique = name;
    }
    Entry entry{.label = name, .params = cli::resolve_params(one, registry)};
    if (entry.params.get_word("technique") == "truth")
      fail_usage("the technique truth is traced by the CPU: see penumbra truth, which prints its rays per second");
    // The camera stands still, unlike in most uses, so that maps would be drawn in the first frame only.
    if (!cli::is_chosen(one, entry.params, "maps.keep")) entry.params.set("maps.keep", false);
    if (options.floor) set_for_floor(entry.params, one);
    refuse_swept(options, entry.params);
    if (options.sweep == "cascades" && entry.params.get_word("cascades.fit") != "stable") {
      fail_usage("--sweep cascades can't be measured with cascades.fit={}, which chooses their number and size",
                 entry.params.get_word("cascades.fit"));
    }
    if (is_preset(name)) entry.label = std::filesystem::path(name).stem().string();
    if (name.empty()) entry.label = entry.params.get_word("technique");
    for (const Entry& other : entries) {
      if (other.label == entry.label) fail_usage("--technique has '{}' twice", entry.label);
    }
    entries.push_back(std::move(entry));
  }
  return entries;
}

cli::InputFiles inputs_of(const Options& options, std::span<const std::filesystem::path> scene_files) {
  cli::InputFiles inputs;
  inputs.add_scene(scene_files);
  inputs.add_presets(options.presets);
  for (const std::string& name : options.techniques) {
    if (is_preset(name)) inputs.add("the preset", name);
  }
  inputs.add_shaders(options);
  return inputs;
}

FrameCounts frame_counts(const Options& options, bool software) {
  constexpr int on_gpu = 400, in_software = 20, in_software_sweep = 4;
  const int usual = !software ? on_gpu : options.sweep.empty() ? in_software : in_software_sweep;
  return {.measured = options.frame_count.value_or(usual), .warmup = options.warmup.value_or(software ? 2 : 20)};
}

}  // namespace penumbra::bench
