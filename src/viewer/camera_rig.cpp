#include "viewer/camera_rig.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "render/setup.h"

namespace penumbra::viewer {

namespace {

// Metres from the target: --eye takes numbers up to ten times as large.
constexpr float farthest = 1e8f;
// Looking straight up or down, "upright" is undefined.
constexpr float steepest = glm::half_pi<float>() - 0.01f;
// At the zenith the azimuth is undefined.
constexpr float highest = glm::half_pi<float>() - 1e-3f;

// As render::direction_to() has them.
struct Angles {
  float azimuth = 0, elevation = 0;
};

Angles angles_of(const glm::vec3& direction) {
  const glm::vec3 unit = glm::normalize(direction);
  return {std::atan2(unit.x, unit.z), std::asin(std::clamp(unit.y, -1.0f, 1.0f))};
}

glm::vec3 turned(const glm::vec3& direction, float yaw, float pitch) {
  const Angles angles = angles_of(direction);
  return glm::length(direction) *
         render::direction_to(angles.azimuth + yaw, std::clamp(angles.elevation + pitch, -steepest, steepest));
}

struct Axes {
  glm::vec3 right, up, back;
};

Axes axes_of(const CameraRig& rig) {
  const glm::vec3 back = glm::normalize(rig.eye - rig.target);
  const glm::vec3 right = glm::normalize(glm::cross(glm::vec3(0, 1, 0), back));
  return {right, glm::cross(back, right), back};
}

}  // namespace

void CameraRig::orbit(float yaw, float pitch) { eye = target + turned(eye - target, yaw, pitch); }

void CameraRig::look(float yaw, float pitch) { target = eye + turned(target - eye, yaw, pitch); }

void CameraRig::pan(const glm::vec2& heights) {
  const float height = 2.0f * distance() * std::tan(fov_y * 0.5f);
  fly({heights.x * height, heights.y * height, 0});
}

void CameraRig::dolly(float factor) {
  // At a smaller distance, eye and target would be equal in single precision.
  const float least = 1e-4f * (1.0f + glm::length(target)), now = distance();
  const float most = std::max(least, farthest);
  eye = target + (eye - target) * (std::clamp(now * factor, least, most) / now);
}

void CameraRig::fly(const glm::vec3& metres) {
  const Axes axes = axes_of(*this);
  const glm::vec3 step = axes.right * metres.x + axes.up * metres.y + axes.back * metres.z;
  eye += step;
  target += step;
}

void CameraRig::frame(const scene::Bounds& bounds, float aspect) {
  const float narrow = std::tan(fov_y * 0.5f) * std::min(aspect, 1.0f);
  const float radius = std::max(bounds.radius(), 1e-3f);
  const glm::vec3 back = glm::normalize(eye - target);
  target = bounds.center();
  eye = target + back * (radius * std::sqrt(1.0f + 1.0f / (narrow * narrow)));
}

float CameraRig::distance() const { return glm::length(eye - target); }

CameraRig rig_of(const render::Camera& camera, const scene::Bounds& bounds) {
  const glm::vec3 forward = -glm::vec3(camera.view[0][2], camera.view[1][2], camera.view[2][2]);
  const float radius = std::max(bounds.radius(), 1e-3f);
  CameraRig rig;
  rig.eye = render::position_of(camera);
  const float ahead = glm::dot(bounds.center() - rig.eye, forward);
  rig.target = rig.eye + forward * std::max(ahead, 0.1f * radius);
  // An orthographic camera's height, at the target.
  rig.fov_y = camera.orthographic ? 2.0f * std::atan(camera.half_height / rig.distance()) : camera.fov_y;
  rig.orbit(0, 0);  // off the poles
  return rig;
}

glm::vec3 turned_light(const glm::vec3& to_light, float azimuth, float elevation) {
  const Angles angles = angles_of(to_light);
  return render::direction_to(angles.azimuth + azimuth, std::clamp(angles.elevation + elevation, 0.0f, highest));
}

}  // namespace penumbra::viewer
