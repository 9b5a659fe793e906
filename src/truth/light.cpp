#include "truth/light.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "shadow/cascades.h"

namespace penumbra::truth {

namespace {

// Rays end at this fraction of the distance to the light, so that geometry which models the lamp's own surface does not
// occlude it.
constexpr float nearly_all_the_way = 0.9999f;

struct Sides {
  glm::dvec3 x, y;
};

// The axes of light space across the light.
Sides sides_about(const glm::dvec3& axis) {
  const glm::dmat3 axes = glm::transpose(shadow::light_axes(axis));
  return {axes[0], axes[1]};
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
