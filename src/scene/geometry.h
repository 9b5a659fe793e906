#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "scene/scene.h"

namespace penumbra::scene {

// Strips, fans and loops as lists; `mode` is glTF's (0 points, 1 lines, 2 loop, 3 strip, 4 triangles, 5 strip, 6 fan).
// Vertices left over at the end of a list are dropped.
std::vector<uint32_t> expanded_indices(int mode, std::span<const uint32_t> indices);
Topology expanded_topology(int mode);

// Gives each triangle vertices of its own and its geometric normal, and each morph target the change of that normal.
// Points and lines get +Y. Degenerate triangles get +Y too.
void make_flat_normals(Primitive& primitive);

// Unit length for all normals; one of no length becomes the area-weighted mean of its triangles' normals. Returns how
// many had none.
std::size_t repair_normals(Primitive& primitive);

// Unit length for all tangents, and a handedness of 1 or -1.
void repair_tangents(Primitive& primitive);

// Tangents of the UV set as `uv_transform` maps it: the sum over each vertex's triangles of the direction of growing u,
// made orthogonal to the normal; handedness from the sum of bitangents. Unlike MikkTSpace it does not split vertices,
// so a vertex shared across a mirrored seam gets the tangent of the larger side.
void make_tangents(Primitive& primitive, int uv_set, const glm::mat3x2& uv_transform);

}  // namespace penumbra::scene
