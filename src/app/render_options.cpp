#include "app/render_options.h"

#include <CLI/CLI.hpp>
#include <functional>

#include "core/names.h"
#include "io/presets.h"
#include "render/renderer.h"

namespace penumbra::app {

namespace {

// An option whose text `set` parses, so that every fault is worded in one place. None takes an empty text.
void value(CLI::App& app, const char* name, const char* type, const char* help,
           const std::function<void(const std::string&)>& set) {
  const auto set_checked = [name, type, set](const std::string& text) {
    if (text.empty()) fail_usage("{} takes {}, not an empty text", name, type);
    set(text);
  };
  app.add_option_function<std::string>(name, set_checked, help)->type_name(type);
}

void words(CLI::App& app, const char* name, const char* type, const char* help, std::vector<std::string>& list) {
  app.add_option(name, list, help)->type_name(type)->allow_extra_args(false);
}

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(' '), end = text.find_last_not_of(' ');
  return begin == std::string::npos ? "" : text.substr(begin, end - begin + 1);
}

void add_aovs(std::vector<std::string>& list, const std::string& text) {
  std::vector<std::string> names;
  for (const render::Aov& aov : render::aovs()) names.push_back(aov.name);
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string name = one_of("AOV", trimmed(text.substr(begin, end - begin)), names);
    if (std::find(list.begin(), list.end(), name) == list.end()) list.push_back(name);
    begin = end + 1;
  }
}

render::GroundChoice ground_choice(const std::string& text) {
  const std::string word = one_of("ground", text, std::vector<std::string>{"auto", "on", "off"});
  if (word == "auto") return render::GroundChoice::automatic;
  return word == "on" ? render::GroundChoice::on : render::GroundChoice::off;
}

void add_view_options(CLI::App& app, RenderOptions& o) {
  value(
      app, "--camera", "NAME|INDEX",
      "A camera of the scene; else its first that sees the scene over a tenth of the picture, else one that frames it",
      [&o](const auto& text) { o.camera = text; });
  value(app, "--eye", "X,Y,Z", "Where the camera is, metres",
        [&o](const auto& text) { o.eye = parse_point("--eye", text); });
  value(app, "--target", "X,Y,Z", "What it looks at, metres",
        [&o](const auto& text) { o.target = parse_point("--target", text); });
  value(app, "--fov", "DEG", "Field of view of the picture's height, degrees",
        [&o](const auto& text) { o.fov = parse_number("--fov", text, 1, 179); });
  value(app, "--sun", "AZIMUTH,ELEVATION",
        "Direction to the sun, degrees: azimuth from +Z towards +X, elevation over the horizon",
        [&o](const auto& text) { o.sun = parse_direction("--sun", text); });
  value(app, "--ground", "auto|on|off", "A plane under the scene; auto: where there is nothing to cast on",
        [&o](const auto& text) { o.ground = ground_choice(text); });
}

void add_time_options(CLI::App& app, RenderOptions& o) {
  value(app, "--time", "S", "Time of the picture, or of frame 0, seconds",
        [&o](const auto& text) { o.time = parse_number("--time", text, 0, 1e6); });
  value(app, "--frames", "FIRST:LAST",
        "A sequence; files are numbered at one #### or %04d in -o, or before its extension",
        [&o](const auto& text) { o.frames = parse_frames("--frames", text); });
  value(app, "--fps", "N", "Frames a second (24)",
        [&o](const auto& text) { o.fps = parse_number("--fps", text, 0.001, 10000); });
  value(app, "--warmup", "N", "Frames drawn and not written before the first, for techniques with memory (0)",
        [&o](const auto& text) { o.warmup = parse_count("--warmup", text, 0, 10000); });
}

void add_shadow_options(CLI::App& app, RenderOptions& o) {
  value(app, "--technique", "NAME", "Shadow technique; see penumbra list techniques",
        [&o](const auto& text) { o.technique = text; });
  value(app, "--sun-angle", "DEG", "Full angle of the sun's disc; short for --set sun.angle=DEG",
        [&o](const auto& text) { o.sun_angle = text; });
  value(app, "--exposure", "EV|auto",
        "Exposure value at ISO 100; short for --set exposure.auto=off --set exposure.ev=EV",
        [&o](const auto& text) { o.exposure = text; });
  words(app, "--set", "NAME=VALUE", "A parameter's value; repeatable; see penumbra list params", o.assignments);
  words(app, "--preset", "FILE", "Values from a TOML file; repeatable", o.presets);
  value(app, "--save-preset", "FILE", "Writes the values of this picture as a preset",
        [&o](const auto& text) { o.save_preset = text; });
}

void add_output_options(CLI::App& app, RenderOptions& o) {
  app.add_option("SCENE", o.scene, "glTF file, .gltf or .glb")->required()->type_name("");
  app.add_option("-o,--output", o.output,
                 "Picture to write: .png (8-bit sRGB) or .exr (linear float); missing folders are made")
      ->required()
      ->type_name("FILE");
  value(app, "--size", "WIDTHxHEIGHT", "Pixels (1280x720)",
        [&o](const auto& text) { o.size = parse_size("--size", text); });
  value(app, "--supersample", "N", "Draws N times larger each way and averages, in linear light (1)",
        [&o](const auto& text) { o.supersample = parse_count("--supersample", text, 1, 16); });
  value(app, "--aov", "NAME,...",
        "Other pictures of the frame: layers of an EXR, or a PNG each; see penumbra list aovs",
        [&o](const auto& text) { add_aovs(o.aovs, text); });
  value(app, "--stats", "FILE", "Writes what each pass cost, and all about the frame, as JSON",
        [&o](const auto& text) { o.stats = text; });
  value(app, "--stats-frames", "N", "Frames measured a picture, after one that is not (1)",
        [&o](const auto& text) { o.stats_frames = parse_count("--stats-frames", text, 1, 10000); });
  app.add_flag("--quiet,-q", o.quiet, "No progress and no summary")->disable_flag_override();
}

void add_device_options(CLI::App& app, RenderOptions& o) {
  value(app, "--backend", "NAME", "auto, egl, osmesa or window (auto)", [&o](const auto& text) {
    o.backend = one_of("backend", text, std::vector<std::string>{"auto", "egl", "osmesa", "window"});
  });
  value(app, "--egl-device", "N", "EGL device by index; see penumbra doctor",
        [&o](const auto& text) { o.egl_device = parse_count("--egl-device", text, 0, 255); });
  value(app, "--threads", "N", "Threads of a software rasteriser (all cores)",
        [&o](const auto& text) { o.threads = parse_count("--threads", text, 1, 1024); });
  value(app, "--glsl", "DIR", "Shaders in this folder replace the built-in ones of the same name",
        [&o](const auto& text) { o.glsl = text; });
  app.add_flag("--debug", o.debug, "KHR_debug: an OpenGL error ends the program (also PENUMBRA_DEBUG=1)")
      ->disable_flag_override();
}

void set_exposure(ParamSet& params, const std::string& text) {
  params.set("exposure.auto", text == "auto");
  if (text != "auto") params.set_text("exposure.ev", text);
}

}  // namespace

void add_render_options(CLI::App& app, RenderOptions& options) {
  add_output_options(app, options);
  add_view_options(app, options);
  add_time_options(app, options);
  add_shadow_options(app, options);
  add_device_options(app, options);
}

void check_together(const RenderOptions& o) {
  if (o.eye.has_value() != o.target.has_value()) fail_usage("--eye and --target go together");
  if (o.eye && o.camera) fail_usage("--eye and --camera exclude each other");
  if (o.eye && *o.eye == *o.target) fail_usage("--eye and --target are the same point");
  if (o.stats_frames > 1 && o.frames) fail_usage("--stats measures each frame of a sequence: leave out --stats-frames");
  if (o.stats_frames > 1 && o.stats.empty()) fail_usage("--stats-frames has no meaning without --stats");
  if (o.egl_device && o.backend != "auto" && o.backend != "egl")
    fail_usage("--egl-device has no meaning for --backend {}", o.backend);
  const long long width = 1LL * o.size.width * o.supersample, height = 1LL * o.size.height * o.supersample;
  if (width > largest_side || height > largest_side || width * height > largest_area)
    fail_usage("a picture of {}x{} pixels (--size times --supersample) is over the limit of {} a side and {} in all",
               width, height, largest_side, largest_area);
}

namespace {

// All names would make a long line.
void check_known(const ParamSet& params, const std::string& name) {
  if (!params.contains(name) && near_names(name, params.names()).empty())
    fail("unknown parameter '{}'; see penumbra list params", name);
}

// What the maps of a light and their pyramids take is 4.3 bytes a texel.
void check_map_memory(const ParamSet& params) {
  const long long size = params.get_int("cascades.size"), count = params.get_int("cascades.count");
  if (size * size * count > largest_maps)
    fail("cascades.count={} maps of cascades.size={} are {} texels: the limit is {} (1.1 GiB), as 4 maps of 8192",
         count, size, size * size * count, largest_maps);
}

}  // namespace

ParamSet resolve_params(const RenderOptions& options, const shadow::Registry& registry) {
  ParamSet params(render::Renderer::params(registry));
  const auto select = [&registry](ParamSet& set, std::string_view name) { registry.select(set, name); };
  for (const std::string& preset : options.presets) io::read_preset(preset, params, select);
  try {
    if (!options.technique.empty()) registry.select(params, options.technique);
    if (!options.sun_angle.empty()) params.set_text("sun.angle", options.sun_angle);
    if (!options.exposure.empty()) set_exposure(params, options.exposure);
    for (const std::string& assignment : options.assignments) {
      if (const std::size_t equals = assignment.find('='); equals != std::string::npos)
        check_known(params, assignment.substr(0, equals));
      params.assign(assignment);
    }
    check_map_memory(params);
  } catch (const Error& error) {
    throw UsageError(error.what());
  }
  return params;
}

}  // namespace penumbra::app
