#include "viewer/document.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

#include "cli/lamp.h"
#include "cli/text.h"
#include "session/techniques.h"

namespace penumbra::viewer {

namespace {

// With the fewest digits that read back as the same values.
std::string text_of(const glm::vec3& v) { return fmt::format("{},{},{}", v.x, v.y, v.z); }

// Degrees with the fewest decimals that read back as the same radians.
std::string degrees_text(float radians) {
  for (int decimals = 0;; ++decimals) {
    const double scale = std::pow(10.0, decimals);
    const double degrees = std::round(glm::degrees(static_cast<double>(radians)) * scale) / scale;
    if (decimals == 12 || static_cast<float>(glm::radians(degrees)) == radians) return fmt::format("{}", degrees);
  }
}

// As one argument, so that a value may begin with a minus sign.
void add(std::vector<std::string>& arguments, const std::string& option, const std::string& value) {
  arguments.push_back(option + "=" + value);
}

// The present frame as a picture without a number, or a sequence.
void add_frames(std::vector<std::string>& arguments, const Document& document,
                const std::optional<cli::FrameRange>& range) {
  if (!range && document.frame == 0) return;
  if (range) {
    add(arguments, "--frames", fmt::format("{}:{}", range->first, range->last));
  } else {
    add(arguments, "--frame", std::to_string(document.frame));
  }
  const double fps = document.options.fps;
  if (fps != cli::SceneOptions{}.fps) add(arguments, "--fps", fmt::format("{}", fps));
}

// The technique or preset that the parameters are nearest to, and what differs from it.
void add_params(std::vector<std::string>& arguments, const ParamSet& params) {
  add(arguments, "--technique", session::selection_of(params).name);
  const ParamSet base = session::unmodified(params);
  for (const Param& row : params.rows()) {
    if (params.value(row.name) == base.value(row.name)) continue;
    add(arguments, "--set", row.name + "=" + to_text(params.value(row.name)));
  }
}

}  // namespace

void Document::step(int frames) { frame = std::max(frame + frames, 0) % (last_frame + 1); }

int warmup_of(const Document& document) {
  constexpr int settled = 31;
  return session::keeps_history(document.params) ? settled : 0;
}

bool changes_once_drawn(const Document& document) {
  return warmup_of(document) > 0 || document.params.get_word("technique") == "truth";
}

bool refines(const Document& document) { return !changes_once_drawn(document) && document.options.samples > 1; }

int frames_of(const Document& document, bool software) {
  constexpr int measured = 60;
  if (!changes_once_drawn(document)) return (software ? 1 : measured) + (refines(document) ? 1 : 0);
  return warmup_of(document) + 1;
}

std::vector<std::string> camera_arguments(const cli::SceneOptions& options) {
  std::vector<std::string> arguments;
  if (options.camera) add(arguments, "--camera", *options.camera);
  if (options.eye) {
    add(arguments, "--eye", text_of(*options.eye));
    add(arguments, "--target", text_of(*options.target));
  }
  if (options.fov) add(arguments, "--fov", fmt::format("{}", *options.fov));
  return arguments;
}

std::vector<std::string> view_arguments(const cli::SceneOptions& options) {
  std::vector<std::string> arguments = camera_arguments(options);
  if (options.sun) {
    add(arguments, "--sun",
        fmt::format("{},{}", degrees_text(options.sun->azimuth), degrees_text(options.sun->elevation)));
  }
  if (options.no_sun) arguments.emplace_back("--no-sun");
  if (options.lights) {
    add(arguments, "--lights", options.lights->empty() ? "none" : fmt::format("{}", fmt::join(*options.lights, ",")));
  }
  if (options.lamp_radius) add(arguments, "--lamp-radius", fmt::format("{}", *options.lamp_radius));
  for (const render::LampLight& lamp : options.lamps) add(arguments, "--lamp", cli::lamp_text(lamp));
  return arguments;
}

// A file as an argument that is no option, also if its name begins with a minus sign.
std::string no_option(const std::string& file) { return file.starts_with('-') ? "./" + file : file; }

std::vector<std::string> scene_arguments(const cli::SceneOptions& options) {
  std::vector<std::string> arguments{no_option(options.scene)};
  add(arguments, "--size", fmt::format("{}x{}", options.size.width, options.size.height));
  for (std::string& argument : view_arguments(options)) arguments.push_back(std::move(argument));
  if (options.ground == render::GroundChoice::on) add(arguments, "--ground", "on");
  if (options.ground == render::GroundChoice::off) add(arguments, "--ground", "off");
  if (options.time != 0) add(arguments, "--time", fmt::format("{}", options.time));
  for (std::string& argument : cli::reading_arguments(options.reading)) arguments.push_back(std::move(argument));
  return arguments;
}

std::vector<std::string> render_arguments(const Document& document, const std::string& output, int warmup,
                                          const std::string& glsl, std::optional<cli::FrameRange> range) {
  std::vector<std::string> arguments{"render"};
  for (std::string& argument : scene_arguments(document.options)) arguments.push_back(std::move(argument));
  arguments.insert(arguments.end(), {"-o", no_option(output)});
  if (document.options.samples != cli::SceneOptions{}.samples)
    add(arguments, "--samples", std::to_string(document.options.samples));
  add_frames(arguments, document, range);
  add_params(arguments, document.params);
  if (warmup > 0) add(arguments, "--warmup", std::to_string(warmup));
  // The viewer's picture shows one moment, and so do its warm-up frames. Those of a sequence play up to its first
  // frame.
  if (warmup > 0 && !range && document.frame > 0) arguments.emplace_back("--warmup-still");
  if (refines(document)) arguments.emplace_back("--sample-shadows");
  if (!glsl.empty()) add(arguments, "--glsl", glsl);
  return arguments;
}

std::string text_of(const Document& document) {
  return cli::command_text("", render_arguments(document, "", /* warmup= */ 0, /* glsl= */ ""));
}

void use_light_indices(cli::SceneOptions& options, const std::vector<std::string>& names) {
  if (!options.lights) return;
  for (std::string& light : *options.lights) {
    if (const std::optional<std::size_t> index = render::index_of_text(names, light))
      light = render::text_of_index(names, *index);
  }
}

CameraRig present_rig(const Document& document, const session::PreparedScene& prepared) {
  CameraRig rig = rig_of(session::setup_at(prepared, document.seconds()).camera, prepared.bounds);
  if (document.options.eye) {
    rig.eye = *document.options.eye;
    rig.target = *document.options.target;
    rig.orbit(0, 0);  // off the poles
  }
  return rig;
}

cli::Direction present_sun(const Document& document, const session::PreparedScene& prepared) {
  if (document.options.sun) return *document.options.sun;
  const glm::vec3 to_light = session::setup_at(prepared, document.seconds()).sun.to_light;
  return {.azimuth = std::atan2(to_light.x, to_light.z), .elevation = std::asin(std::clamp(to_light.y, -1.0f, 1.0f))};
}

void place(Document& document, const session::PreparedScene& prepared, const CameraRig& rig) {
  cli::SceneOptions& options = document.options;
  // Where neither the file nor the options have a sun, its direction was chosen by the camera: keep it.
  if (options.camera && !options.sun && !prepared.setup.sun_node && prepared.setup.sun_shines)
    place_sun(document, prepared.setup.sun.to_light);
  options.camera.reset();
  options.eye = rig.eye;
  options.target = rig.target;
  options.fov = std::clamp(std::round(glm::degrees(static_cast<double>(rig.fov_y)) * 1e4) / 1e4, 1.0, 179.0);
}

void place_sun(Document& document, const glm::vec3& to_light) {
  // Rounded in degrees, so that the printed --sun is exactly what is drawn.
  const auto rounded = [](double radians) { return glm::radians(std::round(glm::degrees(radians) * 1e3) / 1e3); };
  document.options.no_sun = false;
  document.options.sun =
      cli::Direction{.azimuth = static_cast<float>(rounded(std::atan2(to_light.x, to_light.z))),
                     .elevation = static_cast<float>(rounded(std::asin(std::clamp(to_light.y, -1.0f, 1.0f))))};
}

}  // namespace penumbra::viewer
