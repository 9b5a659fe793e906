#pragma once

#include "scene/pose.h"
#include "scene/scene.h"

namespace penumbra::render {

// Of the plane that add_ground() adds, and of what lies around every scene.
inline constexpr float ground_albedo = 0.5f;

// Whether most of the scene stands on a floor of its own, wide enough to show its shadows.
bool has_ground(const scene::Scene& scene, const scene::Pose& pose, const scene::Bounds& bounds);

}  // namespace penumbra::render
