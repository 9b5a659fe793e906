#pragma once

#include "scene/scene.h"

namespace penumbra::bench {

// About so many triangles of casters, by instancing: copies of a torus of 1,000 triangles in a square grid over a
// plane. The grid is as wide whatever their number, so that the picture holds about as much of everything while the
// triangles grow smaller.
scene::Scene caster_grid(long long triangles);

// A scene over and over, side by side, until it has at least so many triangles; itself where it has as many. Skinned
// meshes, which glTF does not instance, stay single. Throws Error where nothing can be repeated.
scene::Scene repeated(scene::Scene scene, long long triangles);

// Triangles as they are drawn: of all nodes, times their instances.
long long drawn_triangles(const scene::Scene& scene);

}  // namespace penumbra::bench
