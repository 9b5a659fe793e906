#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cli/cli_fwd.h"
#include "cli/reading.h"
#include "cli/usage.h"
#include "core/params.h"
#include "render/renderer.h"
#include "render/setup.h"
#include "shadow/registry.h"

namespace penumbra::cli {

// Groups of options that several commands share. Every value is parsed and in range.

// Which picture of which scene: size, camera, sun, ground and time.
struct SceneOptions {
  std::string scene;
  ReadingOptions reading;
  Size size;
  int supersample = 1;
  int samples = render::usual_samples;  // of each pixel of a colour picture that is drawn
  bool own_shadows = false;             // render::FrameInputs::own_shadows

  std::optional<std::string> camera;  // name or index in the file
  std::optional<glm::vec3> eye, target;
  std::optional<double> fov;  // degrees, of the height
  std::optional<Direction> sun;
  bool no_sun = false;
  std::optional<std::vector<std::string>> lights;  // names or indices in the file
  std::optional<double> lamp_radius;               // metres
  std::vector<render::LampLight> lamps;            // besides the file's
  render::GroundChoice ground = render::GroundChoice::automatic;

  double time = 0;  // seconds: of the picture, or of frame 0
  std::optional<FrameRange> frames;
  double fps = 24;
  bool names_fps = false;  // on the command line
};

struct ShadowOptions {
  std::vector<std::string> presets;  // files or names
  std::vector<std::string> assignments;
  std::string technique, sun_angle, exposure;
  // How many of the presets come before --technique on the command line; absent: all.
  std::optional<std::size_t> presets_before_technique;
  // The technique or preset where the user names none; empty: the library's default.
  std::string otherwise;
};

struct DeviceOptions {
  std::string backend = "auto";
  std::optional<int> egl_device, threads;
  std::string glsl;
  bool debug = false;
};

void add_scene_option(CLI::App& app, SceneOptions& options);
void add_size_option(CLI::App& app, SceneOptions& options);
void add_supersample_option(CLI::App& app, SceneOptions& options);
void add_samples_option(
    CLI::App& app, SceneOptions& options,
    const char* help =
        "Samples of each pixel of the colour picture, for smooth edges; they share the first one's shadows (4)");
void add_sample_shadows_option(CLI::App& app, SceneOptions& options);
void add_view_options(CLI::App& app, SceneOptions& options);
void add_time_options(CLI::App& app, SceneOptions& options);
void add_technique_option(CLI::App& app, ShadowOptions& options);
void add_shadow_options(CLI::App& app, ShadowOptions& options);
void add_device_options(CLI::App& app, DeviceOptions& options);

// Throw UsageError for options that can't be combined, and Error if --glsl does not name a folder.
void check_together(const SceneOptions& options);
void check_together(const DeviceOptions& options);

// The values to render with: defaults, then the presets and --technique in the order given, then --sun-angle and
// --exposure, then every --set in the order given. Where a preset and --technique name different techniques, the later
// one counts, and a warning says so. Without a preset, --technique and --set technique=NAME, `otherwise` takes the
// place of --technique. A preset is a file, or what shadow::Registry::select() takes. Throws UsageError if the command
// line is wrong, and Error if a preset is.
ParamSet resolve_params(const ShadowOptions& options, const shadow::Registry& registry);

// For commands that name the technique in another way: a UsageError if --set names one. `instead`: "see --technique".
void refuse_technique(std::span<const std::string> assignments, std::string_view instead);

// Whether the user names a technique: by --technique, a preset that does, or --set technique=NAME.
bool names_technique(const ShadowOptions& options, const shadow::Registry& registry);

// Whether the user set a parameter: by --set, or to another value than its default. `params` are the resolved ones.
bool is_chosen(const ShadowOptions& options, const ParamSet& params, std::string_view name);

// Sets "NAME=VALUE". Throws UsageError; for an unknown name it suggests similar names, or how to list all of them.
void assign(ParamSet& params, const std::string& assignment);

// Adds an option whose text `set` parses. An empty text is refused.
void add_value(CLI::App& app, const char* name, const char* type, const char* help,
               const std::function<void(const std::string&)>& set);

}  // namespace penumbra::cli
