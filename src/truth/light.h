#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <variant>

namespace penumbra::truth {

// A directional light as rays are traced to it. As a disc it has angular diameter `angle` and is sampled uniformly over
// the disc of radius tan(angle / 2) on the tangent plane at unit distance. As a square its half side is that radius,
// and two of its sides are horizontal, as in the shadow library's light space.
struct TracedSun {
  glm::dvec3 to_light{0, 1, 0};  // world space, of any length above 0
  double angle = 0.00925;        // full angle, radians, 0 to below π
  bool square = false;
};

// The directions in which a spot shines.
struct SpotCone {
  glm::dvec3 axis{0};  // unit, world
  double cosine = 0;   // of the half angle
};

// A sphere of `radius` metres about `position`: to a receiver, a disc that faces it. It emits in all directions, or
// within `cone` and `range`: only visibility is traced, not falloff.
struct LocalLight {
  glm::dvec3 position{0};  // world space
  double radius = 0;       // metres
  double clear = 0;        // metres: what is nearer to the disc's plane casts no shadow; it is the lamp itself
  std::optional<SpotCone> cone = {};  // receivers outside of it see nothing of the light
  double range = 0;                   // nor do those farther away, metres; 0: unlimited
};

using TracedLight = std::variant<TracedSun, LocalLight>;

// A light as seen from a point. Rays to it have the directions center + x · side_x + y · side_y, with (x, y) in the
// unit disc, or each from −1 to 1 if `square`. They end at `far` times that vector.
struct SeenLight {
  glm::dvec3 center{0}, side_x{0}, side_y{0};
  float far = 0;
  bool square = false;
  bool shines = true;  // false: the light does not shine in the point's direction
};

SeenLight seen_from(const TracedLight& light, const glm::dvec3& point);

}  // namespace penumbra::truth
