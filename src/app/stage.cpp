#include "app/stage.h"

#include <algorithm>
#include <glm/trigonometric.hpp>

#include "io/image_read.h"
#include "scene/gltf.h"
#include "scene/pose.h"

namespace penumbra::app {

namespace {

void aim(render::Camera& camera, const RenderOptions& options, const scene::Bounds& bounds) {
  const float fov = options.fov ? glm::radians(static_cast<float>(*options.fov)) : camera.fov_y;
  if (options.eye) {
    camera = render::look_at(*options.eye, *options.target, fov, render::near_plane_for(bounds, *options.eye));
  } else if (options.fov) {
    if (camera.orthographic) fail("--fov: the camera is orthographic");
    camera.fov_y = fov;
  }
}

}  // namespace

Stage load_stage(const RenderOptions& options) {
  Stage stage;
  stage.scene = scene::read_gltf(options.scene, io::image_decoder());
  const int first = options.frames ? options.frames->first : 0;
  const scene::Pose pose = scene::pose_at(stage.scene, time_of(options, first));
  const float aspect = static_cast<float>(options.size.width) / static_cast<float>(options.size.height);
  const render::Setup setup =
      render::choose_setup(stage.scene, pose, {options.camera.value_or(""), options.ground, aspect});
  const scene::Bounds bounds = scene::bounds_of(stage.scene, pose);
  stage.camera = setup.camera;
  stage.sun = setup.sun;
  aim(stage.camera, options, bounds);
  if (options.sun) stage.sun.to_light = render::direction_to(options.sun->azimuth, options.sun->elevation);
  if (setup.ground) render::add_ground(stage.scene, bounds);
  return stage;
}

double time_of(const RenderOptions& options, int frame) {
  return options.time + (options.frames ? std::max(frame, 0) / options.fps : 0.0);
}

}  // namespace penumbra::app
