#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <variant>

namespace penumbra::truth {

// A light without end distance: a disc of angular diameter `angle`, sampled uniformly over the disc of radius
// tan(angle / 2) on the tangent plane at unit distance, or a square of half that side, two of whose sides are
// horizontal, as in the shadow library's light space.
struct Sun {
  glm::dvec3 to_light{0, 1, 0};  // world space, any length but 0
  double angle = 0.00925;        // radians, full; 0 to below π
  bool square = false;
};

// A disc of `radius` metres about `position`. With an axis (spot and disc lights) it is perpendicular to that; without
// (point lights: a sphere) it faces the receiver. Both of its sides shine everywhere: what is traced is visibility, and
// cones and falloff are not.
struct LocalLight {
  glm::dvec3 position{0};  // world space
  double radius = 0;       // metres
  std::optional<glm::dvec3> axis;
};

using Light = std::variant<Sun, LocalLight>;

// A light as seen from a point: rays to it have the directions center + x · side_x + y · side_y, with (x, y) in the
// unit disc, or from −1 to 1 each if `square`, and end at `far` of that length.
struct SeenLight {
  glm::dvec3 center{0}, side_x{0}, side_y{0};
  float far = 0;
  bool square = false;
};

SeenLight seen_from(const Light& light, const glm::dvec3& point);

}  // namespace penumbra::truth
