#pragma once

#include "scene/pose.h"
#include "scene/scene.h"

namespace penumbra::render {

// Albedo of the plane that add_ground() adds, and of the ground that the sky model assumes around every scene.
inline constexpr float ground_albedo = 0.5f;

// Whether most of the scene already has a floor below it that is wide enough to show its shadows.
bool has_ground(const scene::Scene& scene, const scene::Pose& pose, const scene::Bounds& bounds);

}  // namespace penumbra::render
