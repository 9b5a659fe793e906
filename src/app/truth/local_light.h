#pragma once

#include <functional>
#include <string>

#include "scene/scene.h"
#include "truth/light.h"

namespace penumbra::app {

// A point or spot light of the scene by name or index, `radius` metres wide, where its node is at a moment (seconds).
// Throws Error, listing near names, where there is none. `scene` must outlive the function.
std::function<truth::LocalLight(double)> local_light(const scene::Scene& scene, const std::string& name, double radius);

}  // namespace penumbra::app
