#include "compare/options.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "cli/input_files.h"
#include "cli/output_names.h"
#include "io/text.h"
#include "session/techniques.h"
#include "truth/reference.h"

namespace penumbra::compare {

namespace {

using cli::add_value;
using cli::fail_usage;

// The most bytes of a scene's reference pictures, which are kept until the last technique is drawn.
constexpr long long largest_reference = 2LL << 30;
constexpr long long reference_bytes = sizeof(float) + 1;  // a pixel: visibility, and whether it is a receiver

// `kept`: the number of reference pictures.
bool too_large(long long kept, const cli::Size& size) {
  return kept * size.width * size.height > largest_reference / reference_bytes;
}

void add_contenders(std::vector<Contender>& list, const std::string& text) {
  for (Contender& contender : parse_contenders(text)) {
    const bool twice =
        std::ranges::any_of(list, [&](const Contender& other) { return other.label == contender.label; });
    if (twice) fail_usage("--technique names '{}' twice", contender.label);
    list.push_back(std::move(contender));
  }
}

void add_compare_options(CLI::App& app, CompareOptions& o, const CommandHelp& help) {
  app.add_option("SCENE", o.scenes, "glTF files, .gltf or .glb")->required()->type_name("");
  add_value(app, "-o,--output", "PATH", help.output,
            [&o](const auto& text) { o.output = cli::output_folder("-o", text); });
  app.get_option("--output")->required();
  add_value(app, "--technique", "NAME,...",
            "Techniques and presets to compare, at least one; NAME:PARAM=VALUE,PARAM=VALUE changes values of one; see "
            "penumbra list techniques",
            [&o](const auto& text) { add_contenders(o.contenders, text); });
  add_value(app, "--reference", "truth|brute_force", "Reference that they are measured against (truth)",
            [&o](const auto& text) {
              o.reference = cli::one_of("reference", text, std::vector<std::string>{"truth", "brute_force"});
            });
  add_value(app, "--spp", "N", "Rays per pixel of the truth; short for --set truth.samples=N (256)",
            [&o](const auto& text) { o.samples = cli::parse_count("--spp", text, 8, 65536); });
  cli::add_size_option(app, o);
  cli::add_view_options(app, o);
  cli::add_time_options(app, o);
  app.get_option("--frames")->description("A sequence: figures are of all its frames, pictures of the last");
  add_value(app, "--orbit", "DEG", "Degrees per frame that the camera circles about its target",
            [&o](const auto& text) { o.orbit = cli::parse_number("--orbit", text, -180, 180); });
  add_value(app, "--cut-at", "FRAME",
            "Frame at which the orbit jumps, so that it ends at its first view (the middle frame)",
            [&o](const auto& text) { o.cut_at = cli::parse_count("--cut-at", text, 0, 1000000); });
  add_value(app, "--warmup", "N", "Frames drawn before a single picture, for techniques with a history (32)",
            [&o](const auto& text) { o.warmup = cli::parse_count("--warmup", text, 0, 10000); });
  add_value(app, "--cost-frames", "N", "Frames whose median is the cost of a single picture (3)",
            [&o](const auto& text) { o.cost_frames = cli::parse_count("--cost-frames", text, 1, 10000); });
  app.add_flag("--no-cost", o.no_cost, "Measure no costs: the same command then writes the same report, byte for byte")
      ->disable_flag_override()
      ->excludes(app.get_option("--cost-frames"));
  cli::add_shadow_options(app, o);
  cli::add_device_options(app, o);
  session::add_cache_options(app, o);
  app.add_flag("--quiet,-q", o.quiet, "No progress and no table")->disable_flag_override();
}

void check_orbit(const CompareOptions& o) {
  if (o.orbit && !o.frames) fail_usage("--orbit moves the camera from frame to frame: it needs --frames");
  if (o.cut_at && !o.orbit) fail_usage("--cut-at needs --orbit");
  if (o.cut_at && (*o.cut_at <= o.frames->first || *o.cut_at > o.frames->last))
    fail_usage("--cut-at {} is not one of the frames {}:{} after the first", *o.cut_at, o.frames->first,
               o.frames->last);
}

void check_together(const CompareOptions& o) {
  cli::check_together(static_cast<const cli::SceneOptions&>(o));
  check_together(static_cast<const session::CacheOptions&>(o));
  if (o.contenders.empty()) fail_usage("--technique is required: what to compare; see penumbra list techniques");
  if (o.reference == "truth" && std::ranges::any_of(o.contenders, [](const auto& c) { return c.name == "truth"; }))
    fail_usage("--technique truth is the reference already; see --reference");
  if (o.samples && o.reference != "truth") fail_usage("--spp is not for --reference {}", o.reference);
  if (o.warmup && o.frames) fail_usage("--warmup is for single pictures: with --frames every frame is measured");
  if (o.cost_frames && o.frames && o.frames->count() > 1)
    fail_usage("--cost-frames is for single pictures: with --frames every frame but the first is timed");
  check_orbit(o);
  const int frames = o.frames ? o.frames->count() : 1;
  if (too_large(frames, o.size))
    fail_usage("{} reference pictures of {}x{} are over the limit of 2 GiB: fewer --frames or a smaller --size", frames,
               o.size.width, o.size.height);
}

// All contenders are drawn with the reference's lights and casters, so no assignment of one contender may change those.
void check_own_assignment(const std::string& assignment) {
  cli::refuse_technique({&assignment, 1}, "see --technique");
  if (truth::is_of_scene(assignment.substr(0, assignment.find('='))))
    fail_usage("'{}' would give a technique {} than the reference's: see --set", assignment,
               assignment.starts_with("sun.") ? "another sun" : "other casters");
}

// Checks each value alone. Whether they can be combined also depends on preset files, which are not read yet.
void check_values(const CompareOptions& options, const shadow::Registry& registry) {
  auto own = static_cast<const cli::ShadowOptions&>(options);
  own.presets.clear();
  own.assignments.clear();
  bool traced = options.reference == "truth";
  for (const Contender& contender : options.contenders) {
    own.technique = contender.name;
    ParamSet defaults = cli::resolve_params(own, registry);
    traced = traced || defaults.get_word("technique") == "truth";
    defaults.set("cascades.count", 1);  // so that maps of any size are within the limit
    const auto check = [&defaults](const std::string& assignment) {
      ParamSet params = defaults;
      cli::assign(params, assignment);
    };
    cli::refuse_technique(options.assignments, "see --technique");
    for (const std::string& assignment : options.assignments) check(assignment);
    for (const std::string& assignment : contender.assignments) {
      check_own_assignment(assignment);
      check(assignment);
    }
  }
  if ((options.cache || options.cache_bytes) && !traced)
    fail_usage("{} is of no use: nothing here is ray traced", options.cache ? "--cache" : "--cache-size");
}

ParamSet params_of(const CompareOptions& options, const Contender& contender, const shadow::Registry& registry) {
  auto own = static_cast<const cli::ShadowOptions&>(options);
  own.technique = contender.name;
  ParamSet params = cli::resolve_params(own, registry);
  // So that costs do not depend on how still the view is.
  if (!cli::is_chosen(own, params, "maps.keep")) params.set("maps.keep", false);
  for (const std::string& assignment : contender.assignments) cli::assign(params, assignment);
  return params;
}

ParamSet reference_params(const CompareOptions& options, const shadow::Registry& registry) {
  auto own = static_cast<const cli::ShadowOptions&>(options);
  own.technique = options.reference;
  if (options.samples)
    own.assignments.insert(own.assignments.begin(), fmt::format("truth.samples={}", *options.samples));
  ParamSet params = cli::resolve_params(own, registry);
  truth::make_reference(params);
  return params;
}

}  // namespace

std::vector<Contender> parse_contenders(const std::string& text) {
  std::vector<Contender> list;
  for (const std::string& part : io::split(text, ',')) {
    const std::size_t colon = part.find(':');
    if (colon == std::string::npos && part.find('=') != std::string::npos) {
      if (list.empty() || list.back().assignments.empty())
        fail_usage("--technique: '{}' sets a value, but follows no technique of the form NAME:PARAM=VALUE", part);
      list.back().label += "," + part;
      list.back().assignments.push_back(part);
      continue;
    }
    Contender contender{.label = part, .name = part.substr(0, colon), .assignments = {}};
    if (contender.name.empty()) fail_usage("--technique: a name is missing in '{}'", text);
    if (colon != std::string::npos) contender.assignments.push_back(part.substr(colon + 1));
    list.push_back(std::move(contender));
  }
  return list;
}

bool parse_compare(const cli::Arguments& arguments, CompareOptions& options, const CommandHelp& help) {
  CLI::App app(
      "Compare shadow techniques with the truth: tables and an HTML page. For the costs, shadow maps are drawn anew in "
      "every frame unless maps.keep is set",
      help.name);
  add_compare_options(app, options, help);
  if (!cli::parse(app, arguments)) return false;
  options.given = cli::given_options(app);
  check_together(options);
  check_values(options, session::all_techniques());
  cli::check_together(static_cast<const cli::DeviceOptions&>(options));  // looks for a folder
  return true;
}

void check_memory(const CompareOptions& options, std::size_t lights) {
  const int frames = options.frames ? options.frames->count() : 1;
  if (too_large(static_cast<long long>(lights) * frames, options.size))
    fail(
        "{} reference pictures of {}x{} for each of {} lights are over the limit of 2 GiB: fewer --frames or a smaller "
        "--size",
        frames, options.size.width, options.size.height, lights);
}

void check_inputs(const CompareOptions& options, std::span<const std::filesystem::path> scene_files) {
  cli::InputFiles inputs;
  inputs.add_scene(scene_files);
  inputs.add_presets(options.presets);
  inputs.add_shaders(options);
  for (const std::filesystem::path& output : {options.page(), options.csv(), options.json()})
    inputs.check("-o", output);
}

ComparedValues values_of(const CompareOptions& options, const shadow::Registry& registry) {
  ComparedValues values{.reference = reference_params(options, registry), .contenders = {}};
  for (const Contender& contender : options.contenders)
    values.contenders.push_back(params_of(options, contender, registry));
  return values;
}

}  // namespace penumbra::compare
