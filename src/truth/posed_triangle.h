#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>

#include "scene/posed_geometry.h"

namespace penumbra::truth {

// A vertex in world space, computed in single precision like the vertex shader.
glm::vec3 world_position(const scene::PosedSurface& surface, std::uint32_t vertex);

// Number of triangles of a surface: 0 for points and lines.
std::size_t triangle_count(const scene::PosedSurface& surface);

using Corners = std::array<glm::dvec3, 3>;

// A triangle in world space. Nothing if it has no area or is not finite: such a triangle neither occludes nor receives.
std::optional<Corners> world_triangle(const scene::PosedSurface& surface, std::size_t triangle);

// Whether a point is finite, and near enough to the origin that its squares and cubes fit single precision.
bool near_enough(const glm::dvec3& point);

}  // namespace penumbra::truth
