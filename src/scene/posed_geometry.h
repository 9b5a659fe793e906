#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "scene/scene.h"

namespace penumbra::scene {

// How a surface casts shadows.
enum class CastMode {
  never,
  always,    // both sides of every triangle
  by_alpha,  // where base colour × vertex colour × texture leaves an alpha of at least the material's cutoff (MASK), or
             // of a half (BLEND)
};

// A primitive at one place, as it is drawn at one time.
struct PosedSurface {
  const Primitive* primitive = nullptr;  // indices, texture coordinates, colours, material; shared by all instances
  std::span<const glm::vec3> positions;  // one per vertex: undeformed, or as skinned and morphed on the GPU
  glm::mat4 world{1};                    // from the space of `positions` to world space
  CastMode casts = CastMode::always;
  CasterFaces faces = CasterFaces::both;  // the faces that cast shadows
  // Whether front faces are clockwise as `positions` and `world` place them: glTF's rule for mirrored nodes.
  bool mirrored = false;
};

// Everything that is drawn at one time, in the order of the GPU's instances, so that the index of a surface is the
// instance index in shaders. Refers to the scene that it was made from.
struct PosedGeometry {
  std::vector<glm::vec3> deformed;  // memory of deformed positions, which some surfaces refer to
  std::vector<PosedSurface> surfaces;

  PosedGeometry() = default;
  PosedGeometry(PosedGeometry&&) = default;
  PosedGeometry& operator=(PosedGeometry&&) = default;
};

}  // namespace penumbra::scene
