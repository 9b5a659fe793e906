#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/cli_fwd.h"
#include "app/usage.h"
#include "core/params.h"
#include "render/setup.h"
#include "shadow/technique.h"

namespace penumbra::app {

// What `penumbra render` was asked for; every value is parsed and in range.
struct RenderOptions {
  std::string scene, output;
  Size size;
  int supersample = 1;

  std::optional<std::string> camera;  // name or index in the file
  std::optional<glm::vec3> eye, target;
  std::optional<double> fov;  // degrees, of the height
  std::optional<Direction> sun;
  render::GroundChoice ground = render::GroundChoice::automatic;

  double time = 0;
  std::optional<FrameRange> frames;
  double fps = 24;
  int warmup = 0;

  std::vector<std::string> presets, assignments;
  std::string technique, sun_angle, exposure;
  std::string save_preset;
  std::vector<std::string> aovs;

  std::string backend = "auto";
  std::optional<int> egl_device, threads;
  std::string glsl;
  bool debug = false;

  std::string stats;
  int stats_frames = 1;
  bool quiet = false;
};

void add_render_options(CLI::App& app, RenderOptions& options);

// Throws UsageError where options that are right alone don't go together.
void check_together(const RenderOptions& options);

// The values to render with: defaults, then presets, then --technique, --sun-angle and --exposure, then every --set in
// the order given. Throws UsageError for the command line's faults and Error for a preset's.
ParamSet resolve_params(const RenderOptions& options, const shadow::Registry& registry);

}  // namespace penumbra::app
