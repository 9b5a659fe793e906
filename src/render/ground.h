#pragma once

#include "scene/pose.h"
#include "scene/scene.h"

namespace penumbra::render {

// Whether most of what lies under the scene is surface already, seen from above.
bool has_ground(const scene::Scene& scene, const scene::Pose& pose, const scene::Bounds& bounds);

}  // namespace penumbra::render
