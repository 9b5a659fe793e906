#include "cli/options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <set>

#include "cli/lamp.h"
#include "core/log.h"
#include "core/names.h"
#include "io/output_file.h"
#include "io/presets.h"
#include "render/renderer.h"
#include "shadow/selection.h"

namespace penumbra::cli {

namespace {

void words(CLI::App& app, const char* name, const char* type, const char* help, std::vector<std::string>& list) {
  app.add_option(name, list, help)->type_name(type)->allow_extra_args(false);
}

render::GroundChoice ground_choice(const std::string& text) {
  const std::string word = one_of("ground", text, std::vector<std::string>{"auto", "on", "off"});
  if (word == "auto") return render::GroundChoice::automatic;
  return word == "on" ? render::GroundChoice::on : render::GroundChoice::off;
}

// "a,b" as names, none of them empty.
std::vector<std::string> split_names(const char* option, const std::string& text) {
  std::vector<std::string> names;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    if (end == begin) fail_usage("{} '{}' has an empty name", option, text);
    names.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return names;
}

}  // namespace

void add_value(CLI::App& app, const char* name, const char* type, const char* help,
               const std::function<void(const std::string&)>& set) {
  const auto set_checked = [name, type, set](const std::string& text) {
    if (text.empty()) fail_usage("{} takes {}, not an empty text", name, type);
    set(text);
  };
  app.add_option_function<std::string>(name, set_checked, help)->type_name(type);
}

void add_scene_option(CLI::App& app, SceneOptions& o) {
  app.add_option("SCENE", o.scene, "glTF file, .gltf or .glb")->required()->type_name("");
}

void add_size_option(CLI::App& app, SceneOptions& o) {
  add_value(app, "--size", "WIDTHxHEIGHT", "Pixels (1280x720)",
            [&o](const auto& text) { o.size = parse_size("--size", text); });
}

void add_supersample_option(CLI::App& app, SceneOptions& o) {
  add_value(app, "--supersample", "N", "Draw N times as wide and as high, and average in linear light (1)",
            [&o](const auto& text) { o.supersample = parse_count("--supersample", text, 1, 16); });
}

void add_samples_option(CLI::App& app, SceneOptions& o, const char* help) {
  add_value(app, "--samples", "N", help,
            [&o](const auto& text) { o.samples = parse_count("--samples", text, 1, render::max_samples); });
}

void add_sample_shadows_option(CLI::App& app, SceneOptions& o) {
  app.add_flag("--sample-shadows", o.own_shadows,
               "Each sample has shadows of its own, without a history, so that edges of shadows are smooth too")
      ->disable_flag_override();
}

void add_view_options(CLI::App& app, SceneOptions& o) {
  add_value(
      app, "--camera", "NAME|INDEX",
      "A camera of the scene; without this option its first that sees the scene, or else one that shows all of it",
      [&o](const auto& text) { o.camera = text; });
  add_value(app, "--eye", "X,Y,Z", "Position of the camera, metres",
            [&o](const auto& text) { o.eye = parse_point("--eye", text); });
  add_value(app, "--target", "X,Y,Z", "Point that the camera looks at, metres",
            [&o](const auto& text) { o.target = parse_point("--target", text); });
  add_value(app, "--fov", "DEG", "Field of view of the picture's height, degrees",
            [&o](const auto& text) { o.fov = parse_number("--fov", text, 1, 179); });
  add_value(app, "--sun", "AZIMUTH,ELEVATION",
            "Direction to the sun, degrees: azimuth from +Z towards +X, elevation over the horizon",
            [&o](const auto& text) { o.sun = parse_direction("--sun", text); });
  app.add_flag("--no-sun", o.no_sun, "Leaves out suns: spots and point lights alone light the scene")
      ->disable_flag_override();
  add_value(app, "--lights", "NAME,...", "Lights of the scene that shine, by name or index; none: none of them (all)",
            [&o](const auto& text) {
              o.lights = text == "none" ? std::vector<std::string>() : split_names("--lights", text);
            });
  add_value(app, "--lamp-radius", "METRES",
            "Radius of the scene's spots and point lights (that of the light's extras, or 0.03)",
            [&o](const auto& text) { o.lamp_radius = parse_number("--lamp-radius", text, 0, 1000); });
  app.add_option_function<std::vector<std::string>>(
         "--lamp",
         [&o](const std::vector<std::string>& texts) {
           for (const std::string& text : texts) {
             o.lamps.push_back(parse_lamp("--lamp", text));
             o.lamps.back().number = static_cast<int>(o.lamps.size()) - 1;
           }
         },
         "A lamp besides the scene's: X,Y,Z, then any of :radius=METRES (0.03) :cd=CANDELA (100) :range=METRES "
         "(unlimited) "
         ":rgb=R,G,B (1,1,1), and for a spot :to=X,Y,Z, where it shines, :cone=DEG (40), from its axis to its rim, and "
         ":inner=DEG (0.8 of the cone), within which it shines in full; repeatable")
      ->type_name("X,Y,Z[:...]")
      ->allow_extra_args(false);
  add_value(app, "--ground", "auto|on|off",
            "A plane under the scene; auto: only where shadows would have nothing to fall on",
            [&o](const auto& text) { o.ground = ground_choice(text); });
  add_reading_options(app, o.reading);
}

void add_time_options(CLI::App& app, SceneOptions& o) {
  add_value(app, "--time", "S", "Time of the picture, or of frame 0, seconds",
            [&o](const auto& text) { o.time = parse_number("--time", text, 0, 1e6); });
  add_value(app, "--frames", "FIRST:LAST",
            "A sequence; files are numbered at one #### or %04d in -o, or before its extension",
            [&o](const auto& text) { o.frames = parse_frames("--frames", text); });
  add_value(app, "--fps", "N", "Frames per second (24)", [&o](const auto& text) {
    o.fps = parse_number("--fps", text, 0.001, 10000);
    o.names_fps = true;
  });
}

void add_technique_option(CLI::App& app, ShadowOptions& o) {
  add_value(app, "--technique", "NAME", "Shadow technique or preset; see penumbra list techniques (slices_denoised)",
            [&o](const auto& text) { o.technique = text; });
  app.parse_complete_callback([&app, &o] {
    std::size_t presets = 0;
    for (const CLI::Option* option : app.parse_order()) {
      if (option->check_name("--preset")) ++presets;
      if (option->check_name("--technique")) o.presets_before_technique = presets;
    }
  });
}

void add_shadow_options(CLI::App& app, ShadowOptions& o) {
  add_value(app, "--sun-angle", "DEG", "Full angle of the sun's disc; short for --set sun.angle=DEG",
            [&o](const auto& text) { o.sun_angle = text; });
  add_value(app, "--exposure", "EV|auto",
            "Exposure value at ISO 100; short for --set exposure.auto=off --set exposure.ev=EV",
            [&o](const auto& text) { o.exposure = text; });
  words(app, "--set", "NAME=VALUE", "A parameter's value; repeatable; see penumbra list params", o.assignments);
  words(
      app, "--preset", "FILE|NAME",
      "Values from a preset file (TOML) or of a preset in penumbra list techniques, before those of --set; repeatable",
      o.presets);
}

void add_device_options(CLI::App& app, DeviceOptions& o) {
  add_value(app, "--backend", "auto|egl|osmesa|window", "How to open an OpenGL context (auto)", [&o](const auto& text) {
    o.backend = one_of("backend", text, std::vector<std::string>{"auto", "egl", "osmesa", "window"});
  });
  add_value(app, "--egl-device", "N", "EGL device by index; see penumbra doctor",
            [&o](const auto& text) { o.egl_device = parse_count("--egl-device", text, 0, 255); });
  add_value(app, "--threads", "N", "Threads of a software rasteriser and of a ray tracer (all cores)",
            [&o](const auto& text) { o.threads = parse_count("--threads", text, 1, 1024); });
  add_value(app, "--glsl", "DIR", "Shaders in this folder replace the built-in ones of the same name",
            [&o](const auto& text) { o.glsl = text; });
  app.add_flag("--debug", o.debug, "KHR_debug: an OpenGL error ends the program (also PENUMBRA_DEBUG=1)")
      ->disable_flag_override();
}

namespace {

void set_exposure(ParamSet& params, const std::string& text) {
  params.set("exposure.auto", text == "auto");
  if (text == "auto") return;
  try {
    params.set_text("exposure.ev", text);
  } catch (const Error&) {
    const Param& row = params.row("exposure.ev");
    fail_usage("--exposure can't be '{}': it takes auto or a number from {:g} to {:g}", text, row.min, row.max);
  }
}

// Also where the distance is too short for a direction in floats.
bool is_same_point(const glm::vec3& a, const glm::vec3& b) { return glm::dot(b - a, b - a) == 0; }

}  // namespace

void check_together(const SceneOptions& o) {
  if (o.sun && o.no_sun) fail_usage("--sun and --no-sun exclude each other");
  if (o.eye.has_value() != o.target.has_value()) fail_usage("--eye and --target go together");
  if (o.eye && o.camera) fail_usage("--eye and --camera exclude each other");
  if (o.eye && is_same_point(*o.eye, *o.target)) fail_usage("--eye and --target are the same point");
  const long long width = 1LL * o.size.width * o.supersample, height = 1LL * o.size.height * o.supersample;
  if (width > largest_side || height > largest_side || width * height > largest_area)
    fail_usage("a picture of {}x{} pixels (--size times --supersample) is over the limit of {} a side and {} in all",
               width, height, largest_side, largest_area);
}

namespace {

void check_shader_folder(const std::filesystem::path& folder) {
  std::error_code unread;
  const std::filesystem::file_status status = std::filesystem::status(folder, unread);
  if (status.type() == std::filesystem::file_type::not_found)
    fail("--glsl: {} is not a folder: nothing has that name", io::quoted(folder));
  if (std::filesystem::exists(status) && !std::filesystem::is_directory(status))
    fail("--glsl: {} is a file, not a folder of shaders", io::quoted(folder));
  const std::filesystem::directory_iterator listed(folder, unread);
  if (unread) fail("--glsl: {} can't be listed: {}", io::quoted(folder), unread.message());
}

}  // namespace

void check_together(const DeviceOptions& o) {
  if (!o.glsl.empty()) check_shader_folder(o.glsl);
  if (o.egl_device && o.backend != "auto" && o.backend != "egl")
    fail_usage("--egl-device is not for --backend {}", o.backend);
}

namespace {

// All names would make a long line.
void check_known(const ParamSet& params, const std::string& name) {
  const bool known = params.contains(name) || params.renamed_from(name) != nullptr;
  if (!known && near_names(name, params.names()).empty())
    fail("unknown parameter '{}'; see penumbra list params", name);
}

// A light's shadow maps and their pyramids take 4.7 bytes per texel.
void check_map_memory(const ParamSet& params) {
  const long long size = params.get_int("cascades.size"), count = params.get_int("cascades.count");
  if (size * size * count > largest_maps)
    fail("cascades.count={} maps of cascades.size={} are {} texels: the limit is {} (1.2 GiB), as 4 maps of 8192",
         count, size, size * size * count, largest_maps);
}

}  // namespace

void assign(ParamSet& params, const std::string& assignment) {
  try {
    if (const std::size_t equals = assignment.find('='); equals != std::string::npos)
      check_known(params, assignment.substr(0, equals));
    params.assign(assignment);
    check_map_memory(params);
  } catch (const UsageError&) {
    throw;
  } catch (const Error& error) {
    throw UsageError(error.what());
  }
}

namespace {

bool is_assigned(const ShadowOptions& options, std::string_view name) {
  const std::string start = fmt::format("{}=", name);
  return std::ranges::any_of(options.assignments, [&](const std::string& text) { return text.starts_with(start); });
}

}  // namespace

void refuse_technique(std::span<const std::string> assignments, std::string_view instead) {
  for (const std::string& text : assignments) {
    if (text.starts_with("technique=")) fail_usage("'{}' can't be set here: {}", text, instead);
  }
}

bool is_chosen(const ShadowOptions& options, const ParamSet& params, std::string_view name) {
  return !params.is_default(name) || is_assigned(options, name);
}

namespace {

bool is_file(const std::string& preset) {
  std::error_code unread;
  return std::filesystem::exists(preset, unread);
}

// Values are resolved again when the file of a preset changes.
void warn_once(const std::string& message) {
  static std::set<std::string> told;
  if (told.insert(message).second) warn("{}", message);
}

// Sets the values of a preset, and returns the technique or preset that it names; empty: none.
std::string apply_preset(const std::string& preset, ParamSet& params, const shadow::Registry& registry) {
  const std::vector<std::string> known = registry.names();
  if (!is_file(preset)) {
    if (std::ranges::find(known, preset) != known.end()) {
      registry.select(params, preset);
      return preset;
    }
    const std::vector<std::string> near = near_names(preset, known);
    if (!near.empty())
      fail("there is neither a preset nor a file '{}'; did you mean '{}'?", preset, fmt::join(near, "' or '"));
  }
  std::string named;
  io::read_preset(preset, params, [&](ParamSet& set, std::string_view name) {
    registry.select(set, name);
    named = name;
  });
  check_map_memory(params);
  return named;
}

// Whether a preset names a technique. What can be read only once, such as a pipe, is taken to do so.
bool names_technique(const std::string& preset, const shadow::Registry& registry) {
  std::error_code unread;
  if (!std::filesystem::is_regular_file(preset, unread)) return true;
  try {
    ParamSet params(render::Renderer::params(registry));
    return !apply_preset(preset, params, registry).empty();
  } catch (const Error&) {
    return true;  // the message follows when its values are needed
  }
}

void select_technique(const std::string& technique, ParamSet& params, const shadow::Registry& registry) {
  try {
    registry.select(params, technique);
  } catch (const Error& error) {
    throw UsageError(error.what());
  }
}

}  // namespace

bool names_technique(const ShadowOptions& options, const shadow::Registry& registry) {
  return !options.technique.empty() || is_assigned(options, "technique") ||
         std::ranges::any_of(options.presets,
                             [&](const std::string& preset) { return names_technique(preset, registry); });
}

namespace {

// The presets and --technique in the order in which they are given.
ParamSet in_order(const ShadowOptions& options, const shadow::Registry& registry) {
  ParamSet params(render::Renderer::params(registry));
  if (!options.otherwise.empty() && !names_technique(options, registry))
    select_technique(options.otherwise, params, registry);
  const std::size_t before = std::min(options.presets_before_technique.value_or(SIZE_MAX), options.presets.size());
  std::string named;  // by the presets before --technique
  for (std::size_t i = 0; i < before; ++i) {
    const std::string name = apply_preset(options.presets[i], params, registry);
    if (!name.empty()) named = name;
  }
  const std::string& technique = options.technique;
  if (!technique.empty()) {
    if (named != technique) shadow::take_back(params, registry, named);
    select_technique(technique, params, registry);
  }
  if (options.presets_before_technique && !named.empty() && named != technique)
    warn_once(fmt::format("--technique {0} comes after a preset that chooses {1}: {0} is drawn", technique, named));
  for (std::size_t i = before; i < options.presets.size(); ++i) {
    const std::string name = apply_preset(options.presets[i], params, registry);
    if (name.empty() || name == technique) continue;
    warn_once(fmt::format("--preset {} comes after --technique {}: {} is drawn", options.presets[i], technique, name));
    // As if --technique were not there, so that nothing of its values stays.
    ShadowOptions others = options;
    others.technique.clear();
    others.presets_before_technique.reset();
    return in_order(others, registry);
  }
  return params;
}

}  // namespace

ParamSet resolve_params(const ShadowOptions& options, const shadow::Registry& registry) {
  ParamSet params = in_order(options, registry);
  try {
    if (!options.sun_angle.empty()) params.set_text("sun.angle", options.sun_angle);
    if (!options.exposure.empty()) set_exposure(params, options.exposure);
  } catch (const Error& error) {
    throw UsageError(error.what());
  }
  for (const std::string& assignment : options.assignments) assign(params, assignment);
  return params;
}

}  // namespace penumbra::cli
