#pragma once

#include <functional>
#include <string>

#include "scene/scene.h"
#include "truth/light.h"

namespace penumbra::app {

// Finds a point or spot light of the scene by name or index. The returned function gives the light, a disc of `radius`
// metres, at the position of its node at a time in seconds; `scene` must outlive it. Throws Error, with similar names,
// if there is no such light.
std::function<truth::LocalLight(double)> local_light(const scene::Scene& scene, const std::string& name, double radius);

}  // namespace penumbra::app
