#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

namespace penumbra::shadow {

using Polygon = std::vector<glm::dvec3>;  // convex

// The faces of a box, each by the numbers that Box::corners() gives its corners, around it.
inline constexpr std::array<std::array<std::size_t, 4>, 6> box_faces = {
    {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}}};

// The points with dot(p, normal) <= limit.
struct HalfSpace {
  glm::dvec3 normal{0};
  double limit = 0;
};

// Leaves the part of a polygon within a half-space. `spare` lends its memory; its points are lost.
void clip(Polygon& polygon, const HalfSpace& side, Polygon& spare);

// Leaves the faces of a convex body's part within a half-space, with the one that the cut makes. None if nothing is
// left.
void clip(std::vector<Polygon>& faces, const HalfSpace& side);

}  // namespace penumbra::shadow
