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

bool CullVolume::holds(const Box& world_box) const {
  const glm::dvec3 middle = (glm::dvec3(world_box.min) + glm::dvec3(world_box.max)) * 0.5;
  const glm::dvec3 half = (glm::dvec3(world_box.max) - glm::dvec3(world_box.min)) * 0.5;
  return std::ranges::all_of(planes, [&](const glm::dvec4& plane) {
    const glm::dvec3 normal(plane);
    return glm::dot(normal, middle) + glm::dot(glm::abs(normal), half) + plane.w >= 0;
  });
}

}  // namespace penumbra::shadow
