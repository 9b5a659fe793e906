#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "scene/scene.h"

namespace penumbra::scene {

// Indices of strips, fans and loops expanded to lists. `mode` is glTF's (0 points, 1 lines, 2 line loop, 3 line strip,
// 4 triangles, 5 triangle strip, 6 triangle fan). Incomplete primitives at the end of a list are dropped.
std::vector<uint32_t> expanded_indices(int mode, std::span<const uint32_t> indices);
Topology expanded_topology(int mode);

// Gives each triangle its own vertices and its geometric normal, and each morph target the change of that normal.
// Points, lines and degenerate triangles get the normal +Y.
void make_flat_normals(Primitive& primitive);

// Normalises all normals; one of length zero is replaced by the area-weighted mean of its triangles' normals. Returns
// how many were replaced.
std::size_t repair_normals(Primitive& primitive);

// Normalises all tangents, and sets their handedness to 1 or -1.
void repair_tangents(Primitive& primitive);

// Computes tangents for the UV set as `uv_transform` maps it. Each vertex gets the sum over its triangles of the
// direction of increasing u, made orthogonal to the normal; the sum of bitangents gives the handedness. Unlike
// MikkTSpace it does not split vertices, so a vertex shared across a mirrored seam gets the tangent of the larger side.
void make_tangents(Primitive& primitive, int uv_set, const glm::mat3x2& uv_transform);

}  // namespace penumbra::scene
