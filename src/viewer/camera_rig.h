#pragma once

#include <glm/glm.hpp>

#include "render/view.h"
#include "scene/pose.h"

namespace penumbra::viewer {

// An upright camera that the user moves. World space, metres, radians.
struct CameraRig {
  glm::vec3 eye{0, 1, 3}, target{0};
  float fov_y = 0.7f;  // of the picture's height

  // Moves the eye about the target: `yaw` about the vertical, `pitch` over the horizon, which stops short of the poles.
  void orbit(float yaw, float pitch);
  // Turns the target about the eye, likewise.
  void look(float yaw, float pitch);
  // Moves eye and target parallel to the picture, in picture heights at the target's distance; y up.
  void pan(const glm::vec2& heights);
  // Multiplies the distance to the target; never reaches it.
  void dolly(float factor);
  // Moves eye and target along right, up and back, metres.
  void fly(const glm::vec3& metres);
  // Puts the target at the box's centre and moves back along the line of sight until all of the box is visible.
  void frame(const scene::Bounds& bounds, float aspect);

  float distance() const;
  bool operator==(const CameraRig&) const = default;
};

// The rig that shows what a camera shows, upright; its target is the point of the line of sight nearest to the box's
// centre, in front of the eye.
CameraRig rig_of(const render::Camera& camera, const scene::Bounds& bounds);

// A direction towards a light, turned by the user: azimuth about the vertical, elevation 0 to 90 degrees. Unit,
// radians.
glm::vec3 turned_light(const glm::vec3& to_light, float azimuth, float elevation);

}  // namespace penumbra::viewer
