#pragma once

#include <cstdint>
#include <vector>

#include "scene/pose.h"
#include "scene/scene.h"

namespace penumbra::scene {

// Consecutive triangles of a primitive, and the box that they lie in.
struct MeshPart {
  std::uint32_t first_index = 0, index_count = 0;  // within the primitive's indices
  Bounds box;                                      // in the space of its vertices
};

// Divides the triangles of a primitive into parts, so that of a large mesh only the parts within a volume are drawn.
// The order of the triangles stays, in which files usually list neighbours one after the other. There are at most 64
// parts; one of few triangles has none. Only for triangles that do not deform.
std::vector<MeshPart> parts_of(const Primitive& primitive);

}  // namespace penumbra::scene
