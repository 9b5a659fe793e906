#include "volume.h"

#include <algorithm>

namespace penumbra::shadow {

std::array<glm::dvec3, 8> Box::corners() const {
  std::array<glm::dvec3, 8> corners;
  for (int i = 0; i < 8; ++i) {
    corners[static_cast<size_t>(i)] = {(i & 1) != 0 ? max.x : min.x, (i & 2) != 0 ? max.y : min.y,
                                       (i & 4) != 0 ? max.z : min.z};
  }
  return corners;
}

namespace {

// Least and greatest distance of a box in front of a plane; not metres for an unused plane, which is 0.
struct Distances {
  double least = 0, greatest = 0;
};

Distances distances(const Box& box, const glm::dvec4& plane) {
  const glm::dvec3 middle = (glm::dvec3(box.min) + glm::dvec3(box.max)) * 0.5;
  const glm::dvec3 half = (glm::dvec3(box.max) - glm::dvec3(box.min)) * 0.5;
  const glm::dvec3 normal(plane);
  const double distance = glm::dot(normal, middle) + plane.w;
  const double extent = glm::dot(glm::abs(normal), half);
  return {distance - extent, distance + extent};
}

}  // namespace

bool CullVolume::holds(const Box& world_box) const {
  return std::ranges::all_of(planes,
                             [&](const glm::dvec4& plane) { return distances(world_box, plane).greatest >= 0; });
}

bool CullVolume::contains(const Box& world_box) const {
  return std::ranges::all_of(planes, [&](const glm::dvec4& plane) { return distances(world_box, plane).least >= 0; });
}

}  // namespace penumbra::shadow
