/** @file
 * GLM's types for the fields of penumbra.h, and back. Copies element by element, so that it is right with every switch
 * of GLM that changes how types lie in memory (GLM_FORCE_DEFAULT_ALIGNED_GENTYPES, GLM_FORCE_QUAT_DATA_WXYZ…).
 */
#ifndef PENUMBRA_GLM_HPP
#define PENUMBRA_GLM_HPP

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "penumbra.h"

namespace penumbra::api {

/// To a matrix of penumbra_frame.
inline void copy(const glm::mat4& from, float (&to)[16]) {
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) to[4 * column + row] = from[column][row];
  }
}

/// To a direction, position or corner.
inline void copy(const glm::vec3& from, float (&to)[3]) {
  for (int i = 0; i < 3; ++i) to[i] = from[i];
}

/// A matrix of penumbra_caster_pass.
inline glm::mat4 matrix(const float (&from)[16]) {
  glm::mat4 to(1.0f);
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) to[column][row] = from[4 * column + row];
  }
  return to;
}

/// The box between two corners, of which `min` has the lesser value of each coordinate.
inline penumbra_box box(const glm::vec3& min, const glm::vec3& max) {
  penumbra_box made{};
  copy(min, made.min);
  copy(max, made.max);
  return made;
}

}  // namespace penumbra::api

#endif
