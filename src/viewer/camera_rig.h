#pragma once

#include <glm/glm.hpp>

#include "render/view.h"
#include "scene/pose.h"

namespace penumbra::viewer {

// An upright camera that a hand moves. World space, metres, radians.
struct CameraRig {
  glm::vec3 eye{0, 1, 3}, target{0};
  float fov_y = 0.7f;  // of the picture's height

  // About the target: `yaw` about the vertical, `pitch` over the horizon, which stops short of the poles.
  void orbit(float yaw, float pitch);
  // About the eye.
  void look(float yaw, float pitch);
  // Eye and target across the picture, in heights of it at the target's distance; y up.
  void pan(const glm::vec2& heights);
  // Towards the target for factors below 1, away above. Never reaches it.
  void dolly(float factor);
  // Eye and target along right, up and back, metres.
  void fly(const glm::vec3& metres);
  // Back along the line of sight until all of a box is seen, the target at its centre.
  void frame(const scene::Bounds& bounds, float aspect);

  float distance() const;
  bool operator==(const CameraRig&) const = default;
};

// The rig that shows what a camera shows, upright; its target is the point of the line of sight nearest to the box's
// centre, in front of the eye.
CameraRig rig_of(const render::Camera& camera, const scene::Bounds& bounds);

// A direction towards a light, turned by a hand: azimuth about the vertical, elevation 0 to 90 degrees. Unit, radians.
glm::vec3 turned_light(const glm::vec3& to_light, float azimuth, float elevation);

}  // namespace penumbra::viewer
