#pragma once

#include <array>
#include <glm/glm.hpp>

namespace penumbra::shadow {

// An axis-aligned box in world space, metres.
struct Box {
  glm::vec3 min{0}, max{0};

  std::array<glm::dvec3, 8> corners() const;
  bool operator==(const Box&) const = default;
};

// The convex volume that contains every caster which matters to one layer of a shadow map: the points in front of all
// its planes.
struct CullVolume {
  // A point p is in front of a plane if dot(xyz, p) + w >= 0; xyz has unit length. An unused plane is all 0. World
  // space, metres.
  std::array<glm::dvec4, 6> planes{};

  // Conservative: false only if the box lies outside of the volume.
  bool holds(const Box& world_box) const;
  // Whether the whole box lies inside of the volume, so that what it contains need not be tested.
  bool contains(const Box& world_box) const;
};

}  // namespace penumbra::shadow
