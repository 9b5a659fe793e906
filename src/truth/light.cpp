#include "truth/light.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace penumbra::truth {

namespace {

// Rays end at this fraction of the distance to the light, so that geometry which models the lamp's own surface does not
// occlude it.
constexpr float nearly_all_the_way = 0.9999f;

struct Sides {
  glm::dvec3 x, y;
};

// Two unit vectors perpendicular to a unit vector and to each other, the first one horizontal. Must match
// shadow/cascades.cpp.
Sides sides_about(const glm::dvec3& axis) {
  const glm::dvec3 z = -axis;
  const glm::dvec3 horizontal = glm::cross(z, glm::dvec3(0, 1, 0));
  const glm::dvec3 x = glm::length(horizontal) > 1e-6 ? glm::normalize(horizontal) : glm::dvec3(1, 0, 0);
  return {x, glm::cross(x, z)};
}

SeenLight seen(const TracedSun& sun, const glm::dvec3& /*point*/) {
  const glm::dvec3 center = glm::normalize(sun.to_light);
  const Sides sides = sides_about(center);
  const double tangent = std::tan(sun.angle / 2);
  return {center, sides.x * tangent, sides.y * tangent, std::numeric_limits<float>::infinity(), sun.square};
}

SeenLight seen(const LocalLight& light, const glm::dvec3& point) {
  const glm::dvec3 center = light.position - point;
  const double distance = glm::length(center);
  const Sides sides = sides_about(distance > 0 ? center / distance : glm::dvec3(0, 1, 0));
  const auto clear = static_cast<float>(1 - light.clear / std::max(distance, light.clear + 1e-9));
  SeenLight seen{center, sides.x * light.radius, sides.y * light.radius, std::min(nearly_all_the_way, clear), false};
  seen.shines = (light.range <= 0 || distance <= light.range) &&
                (!light.cone || glm::dot(-center, light.cone->axis) >= light.cone->cosine * distance);
  return seen;
}

}  // namespace

SeenLight seen_from(const TracedLight& light, const glm::dvec3& point) {
  return std::visit([&](const auto& kind) { return seen(kind, point); }, light);
}

}  // namespace penumbra::truth
