#include "compare/camera_path.h"

#include <glm/gtc/matrix_transform.hpp>

#include "scene/animation.h"
#include "scene/pose.h"

namespace penumbra::compare {

namespace {

// The point on the axis of the camera at that time, in front of it, that is nearest to the scene's centre.
glm::vec3 target_of(const CompareOptions& options, const session::PreparedScene& prepared, double time) {
  if (options.target) return *options.target;
  const render::Camera camera = session::setup_at(prepared, time).camera;
  const glm::vec3 eye = render::position_of(camera);
  const glm::vec3 forward = -glm::vec3(camera.view[0][2], camera.view[1][2], camera.view[2][2]);
  const scene::Bounds bounds = scene::bounds_of(prepared.scene, scene::pose_at(prepared.scene, time));
  const float distance = glm::dot(bounds.center() - eye, forward);
  return eye + forward * (distance > 0 ? distance : bounds.radius());
}

// Rotates the camera about a vertical axis.
void rotate(render::Camera& camera, const glm::vec3& center, double degrees) {
  glm::mat4 world = glm::translate(glm::mat4(1), center);
  world = glm::rotate(world, glm::radians(static_cast<float>(degrees)), glm::vec3(0, 1, 0));
  world = glm::translate(world, -center);
  camera.view = camera.view * glm::inverse(world);
}

}  // namespace

CameraPath::CameraPath(const CompareOptions& options, const session::PreparedScene& prepared)
    : options_(options),
      prepared_(prepared),
      range_(options.frames.value_or(cli::FrameRange{})),
      target_(target_of(options, prepared, session::time_of(options, range_.first))) {
  if (options.orbit && range_.count() > 1) cut_ = options.cut_at.value_or(range_.first + range_.count() / 2);
}

// The first and the last frame of the orbit show the requested view.
void CameraPath::orbit(render::Camera& camera, int frame) const {
  if (!options_.orbit) return;
  const bool after_cut = cut_ && frame >= *cut_;
  rotate(camera, target_, *options_.orbit * (frame - (after_cut ? range_.last : range_.first)));
}

bool CameraPath::cuts(int frame) const {
  if (frame == range_.first) return false;
  return frame == cut_ || scene::jumps_between(prepared_.scene, session::time_of(options_, frame - 1),
                                               session::time_of(options_, frame));
}

render::FrameInputs CameraPath::frame(int frame, bool again) const {
  const bool follows = !again && frame > range_.first && !cuts(frame);
  const int last = follows ? frame - 1 : frame;
  render::FrameInputs inputs = session::frame_inputs(prepared_, options_.size,
                                                     {.time = session::time_of(options_, frame),
                                                      .last_time = session::time_of(options_, last),
                                                      .cut = !follows && !again});
  orbit(inputs.camera, frame);
  orbit(inputs.last_camera, last);
  return inputs;
}

std::vector<render::FrameLight> CameraPath::lights(int frame) const {
  return render::shadowed_lights(session::setup_at(prepared_, session::time_of(options_, frame)));
}

}  // namespace penumbra::compare
