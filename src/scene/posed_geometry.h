#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "scene/scene.h"

namespace penumbra::scene {

// How a surface casts shadows.
enum class Casts {
  never,
  always,    // both sides of every triangle
  by_alpha,  // where base colour × vertex colour × texture leaves an alpha of at least the material's cutoff (MASK), or
             // of a half (BLEND)
};

// A primitive at a place, as it is drawn at a moment.
struct PosedSurface {
  const Primitive* primitive = nullptr;  // indices, texture coordinates, colours, material; shared by its copies
  std::span<const glm::vec3> positions;  // one a vertex: at rest, or as skins and morphs left them on the GPU
  glm::mat4 world{1};                    // what takes them to world space
  Casts casts = Casts::always;
  CasterFaces faces = CasterFaces::both;  // of it that cast
  // Front faces are clockwise, as `positions` and `world` place them: glTF's rule for mirrored nodes.
  bool mirrored = false;
};

// All that is drawn at a moment, in the order of the GPU's instances, so that the index of a surface is what shaders
// know as the instance. Refers to the scene that it was made of.
struct PosedGeometry {
  std::vector<glm::vec3> deformed;  // what some positions refer to
  std::vector<PosedSurface> surfaces;

  PosedGeometry() = default;
  PosedGeometry(PosedGeometry&&) = default;
  PosedGeometry& operator=(PosedGeometry&&) = default;
};

}  // namespace penumbra::scene
