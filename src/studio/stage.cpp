#include "studio/stage.h"

#include <algorithm>
#include <glm/trigonometric.hpp>
#include <utility>

#include "scene/gltf.h"
#include "scene/pose.h"

namespace penumbra::studio {

namespace {

void place_camera(render::Setup& setup, const StageOptions& options, const scene::Bounds& bounds) {
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

void choose(Stage& stage, const StageOptions& options, render::GroundChoice ground) {
  const float aspect = static_cast<float>(options.size.width) / static_cast<float>(options.size.height);
  stage.setup = render::choose_setup(
      stage.scene, scene::pose_at(stage.scene, options.time),
      {.camera = options.camera.value_or(""), .ground = ground, .aspect = aspect, .bounds = stage.bounds});
  place_camera(stage.setup, options, stage.bounds);
  if (options.sun) {
    stage.setup.sun.to_light = render::direction_to(options.sun->azimuth, options.sun->elevation);
    stage.setup.sun_node.reset();
  }
}

}  // namespace

void aim(Stage& stage, const StageOptions& options) {
  choose(stage, options, stage.setup.ground ? render::GroundChoice::on : render::GroundChoice::off);
}

Stage set_up(scene::Scene scene, const StageOptions& options) {
  Stage stage{.scene = std::move(scene), .bounds = {}, .setup = {}};
  stage.bounds = scene::bounds_of(stage.scene, scene::pose_at(stage.scene, options.time));
  choose(stage, options, options.ground);
  if (stage.setup.ground) render::add_ground(stage.scene, stage.bounds);
  return stage;
}

Stage load_stage(const StageOptions& options, const scene::ImageDecoder& decode) {
  return set_up(scene::read_gltf(options.scene, decode), options);
}

render::Setup setup_at(const Stage& stage, double seconds) {
  render::Setup setup = stage.setup;
  const bool attached = setup.camera_node || setup.sun_node;
  if (attached && !stage.scene.animations.empty()) render::follow(setup, scene::pose_at(stage.scene, seconds));
  return setup;
}

double time_of(const StageOptions& options, int frame) {
  return options.time + (options.frames ? std::max(frame, 0) / options.fps : 0.0);
}

}  // namespace penumbra::studio
