#pragma once

#include "scene/scene.h"

namespace penumbra::bench {

// A scene with about `triangles` triangles of casters: instances of a torus of 1,000 triangles in a square grid over a
// plane. The width of the grid does not depend on their number, so that casters and shadows cover about the same share
// of the picture while the triangles become smaller.
scene::Scene caster_grid(long long triangles);

// Copies of a scene side by side, with at least `triangles` triangles in total; the scene itself if it has as many.
// Skinned meshes are not copied, because glTF can't instance them. Throws Error if nothing can be copied.
scene::Scene repeated(scene::Scene scene, long long triangles);

// The number of triangles drawn: of all nodes, times their instances.
long long drawn_triangles(const scene::Scene& scene);

}  // namespace penumbra::bench
