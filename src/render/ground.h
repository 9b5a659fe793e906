#pragma once

#include "scene/pose.h"
#include "scene/scene.h"

namespace penumbra::render {

// Albedo of the plane that add_ground() adds.
inline constexpr float ground_albedo = 0.5f;

// The floor that a scene already has.
struct Floor {
  bool wide = false;                // it is below most of the scene, wide enough to show its shadows
  glm::vec3 albedo{ground_albedo};  // of the material that covers most of it, unless that has a texture
};
Floor find_floor(const scene::Scene& scene, const scene::Pose& pose, const scene::Bounds& bounds);

}  // namespace penumbra::render
