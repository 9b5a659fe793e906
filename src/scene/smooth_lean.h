#pragma once

#include <vector>

#include "scene/scene.h"

namespace penumbra::scene {

// For each vertex of a primitive: how far smooth normals lean away from the triangles' own around it. It is the sine of
// the largest angle at a corner of these triangles, from 0 where surfaces are flat to 0.27. Vertices at one place with
// one normal get one value, so that it is continuous over seams of texture coordinates.
//
// Triangles whose normals lean by 15 to 30 degrees and more count less and less: those smooth over an edge between flat
// faces instead of following a round body. Lines, points, triangles without area and normals of length 0 have no lean.
// That of a deformed primitive is that of its rest pose, and nodes whose scales differ by axis are not looked at.
std::vector<float> smooth_leans(const Primitive& primitive);

}  // namespace penumbra::scene
