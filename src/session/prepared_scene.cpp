#include "session/prepared_scene.h"

#include <algorithm>
#include <glm/trigonometric.hpp>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "core/log.h"
#include "scene/animation.h"
#include "scene/gltf.h"
#include "scene/pose.h"

namespace penumbra::session {

namespace {

void place_camera(render::Setup& setup, const cli::SceneOptions& options, const scene::Bounds& bounds) {
  render::Camera& camera = setup.camera;
  const float fov = options.fov ? glm::radians(static_cast<float>(*options.fov)) : camera.fov_y;
  if (options.eye) {
    camera = render::look_at(*options.eye, *options.target, fov, render::near_plane_for(bounds, *options.eye));
    setup.camera_node.reset();
  } else if (options.fov) {
    if (camera.orthographic) fail("--fov: the camera is orthographic");
    camera.fov_y = fov;
  }
}

// In its scope, what this thread logs is kept; then it is logged, unless it was before.
class LogOnce {
 public:
  explicit LogOnce(std::set<std::string>& told) : told_(told) { scope_.emplace(keep_); }
  ~LogOnce() {
    scope_.reset();
    for (const auto& [level, message] : said_) {
      if (!told_.contains(message)) log(level, message);
    }
    for (auto& [level, message] : said_) told_.insert(std::move(message));
  }
  LogOnce(const LogOnce&) = delete;
  LogOnce& operator=(const LogOnce&) = delete;

 private:
  std::set<std::string>& told_;
  std::vector<std::pair<LogLevel, std::string>> said_;
  const LogSink keep_ = [this](LogLevel level, std::string_view message) { said_.emplace_back(level, message); };
  std::optional<ThreadLogSink> scope_;
};

void choose(PreparedScene& prepared, const cli::SceneOptions& options, render::GroundChoice ground) {
  const LogOnce once(prepared.told);
  const float aspect = static_cast<float>(options.size.width) / static_cast<float>(options.size.height);
  prepared.setup = render::choose_setup(
      prepared.scene, scene::pose_at(prepared.scene, options.time),
      {.camera = options.camera.value_or(""),
       .ground = ground,
       .aspect = aspect,
       .bounds = prepared.bounds,
       .lights = options.lights,
       .no_sun = options.no_sun,
       .own_sun = options.sun.has_value(),
       .lamp_radius = options.lamp_radius ? std::optional(static_cast<float>(*options.lamp_radius)) : std::nullopt,
       .lamps = options.lamps});
  place_camera(prepared.setup, options, prepared.bounds);
  if (options.sun) {
    prepared.setup.sun.to_light = render::direction_to(options.sun->azimuth, options.sun->elevation);
    prepared.setup.sun_node.reset();
  }
}

// Of the scene in a pose at this time.
void check_reach(const scene::Scene& scene, double seconds, double reach) {
  const double limit = scene::ReadLimits().extent;
  if (reach <= limit) return;
  fail("{}: at {:g} s it {}", scene.files.empty() ? "the scene" : scene.files.back().string(), seconds,
       scene::over_extent(reach, limit));
}

// Without the ground, which is many times as wide as the scene.
void check_extent(const PreparedScene& prepared, double seconds) {
  if (prepared.scene.animations.empty()) return;
  scene::Pose pose = scene::pose_at(prepared.scene, seconds);
  if (prepared.reach.at(pose) <= scene::ReadLimits().extent) return;
  for (std::size_t i = 0; i < pose.drawn.size(); ++i) {
    if (prepared.scene.nodes[i].ground) pose.drawn[i] = false;
  }
  check_reach(prepared.scene, seconds, scene::reach_of(prepared.scene, pose));
}

}  // namespace

void check_extent(const scene::Scene& scene, double seconds) {
  if (scene.animations.empty()) return;
  check_reach(scene, seconds, scene::reach_of(scene, scene::pose_at(scene, seconds)));
}

void update_view(PreparedScene& prepared, const cli::SceneOptions& options) {
  choose(prepared, options, prepared.setup.ground ? render::GroundChoice::on : render::GroundChoice::off);
}

PreparedScene prepare_scene(scene::Scene scene, const cli::SceneOptions& options) {
  PreparedScene prepared{.scene = std::move(scene), .bounds = {}, .setup = {}};
  prepared.bounds = scene::bounds_of(prepared.scene, scene::pose_at(prepared.scene, options.time));
  choose(prepared, options, options.ground);
  if (!prepared.scene.animations.empty()) prepared.reach = scene::ReachBound(prepared.scene);
  if (prepared.setup.ground) render::add_ground(prepared.scene, prepared.bounds);
  return prepared;
}

PreparedScene load_scene(const cli::SceneOptions& options, const scene::ImageDecoder& decode) {
  scene::Scene scene = cli::read_scene(options.scene, options.reading, decode);
  check_extent(scene, options.time);
  return prepare_scene(std::move(scene), options);
}

cli::LightKinds kinds_of_light(const PreparedScene& prepared) {
  cli::LightKinds kinds{.sun = false, .lamps = false};
  for (const render::FrameLight& light : render::frame_lights(prepared.setup))
    (std::holds_alternative<render::SunLight>(light) ? kinds.sun : kinds.lamps) = true;
  return kinds;
}

render::Setup setup_at(const PreparedScene& prepared, double seconds) {
  render::Setup setup = prepared.setup;
  const bool attached = setup.camera_node || setup.sun_node || !setup.lights.empty();
  if (attached && !prepared.scene.animations.empty()) render::follow(setup, scene::pose_at(prepared.scene, seconds));
  return setup;
}

render::FrameInputs frame_inputs(const PreparedScene& prepared, const cli::Size& pixels, const FrameTime& when) {
  check_extent(prepared, when.time);
  if (when.last_time != when.time) check_extent(prepared, when.last_time);
  const render::Setup setup = setup_at(prepared, when.time);
  return {.width = pixels.width,
          .height = pixels.height,
          .camera = setup.camera,
          .last_camera = when.last_time == when.time ? setup.camera : setup_at(prepared, when.last_time).camera,
          .lights = render::frame_lights(setup),
          .light_ids = render::light_ids(setup),
          .light_names = render::shining_names(setup),
          .time = when.time,
          .last_time = when.last_time,
          .cut = when.cut || scene::jumps_between(prepared.scene, when.last_time, when.time),
          .ground_color = setup.ground_color,
          .on_ground = setup.on_ground,
          .told_hidden = prepared.told_hidden};
}

double time_of(const cli::SceneOptions& options, int frame) {
  return options.time + (options.frames ? std::max(frame, 0) / options.fps : 0.0);
}

}  // namespace penumbra::session
