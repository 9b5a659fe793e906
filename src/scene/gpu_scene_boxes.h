#pragma once

#include <glm/glm.hpp>

#include "scene/pose.h"

namespace penumbra::scene {

// The bounding box of a transformed box.
inline Bounds transformed(const Bounds& box, const glm::mat4& matrix) {
  if (box.empty) return box;
  const glm::vec3 half = box.extent() * 0.5f;
  const glm::vec3 center(matrix * glm::vec4(box.center(), 1.0f));
  const glm::mat3 m(matrix);
  const glm::vec3 extent = glm::abs(m[0]) * half.x + glm::abs(m[1]) * half.y + glm::abs(m[2]) * half.z;
  Bounds moved;
  moved.add(center - extent);
  moved.add(center + extent);
  return moved;
}

// The cofactor matrix: how a matrix transforms cross products. Also defined for singular matrices.
inline glm::mat3 area_matrix(const glm::mat3& m) {
  return {glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])};
}

// Whether a matrix turns counter-clockwise triangles clockwise.
inline bool is_mirror(const glm::mat4& m) {
  return glm::dot(glm::vec3(m[0]), glm::cross(glm::vec3(m[1]), glm::vec3(m[2]))) < 0.0f;
}

}  // namespace penumbra::scene
