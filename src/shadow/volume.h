#pragma once

#include <array>
#include <glm/glm.hpp>

namespace penumbra::shadow {

// An axis-aligned box in world space, metres.
struct Box {
  glm::vec3 min{0}, max{0};

  std::array<glm::dvec3, 8> corners() const;
};

// Where casters can be that matter to one layer of a shadow map: the part of the world before all of some planes.
struct CullVolume {
  // A point p is before a plane if dot(xyz, p) + w >= 0; xyz is of unit length, or all is 0 and the plane cuts nothing
  // off. World space, metres.
  std::array<glm::dvec4, 6> planes{};

  // False only if nothing in the box can cast on the layer.
  bool holds(const Box& world_box) const;
};

}  // namespace penumbra::shadow
