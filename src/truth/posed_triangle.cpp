#include "truth/posed_triangle.h"

#include <cmath>

namespace penumbra::truth {

namespace {

constexpr double furthest = 1e12;  // metres

}  // namespace

bool near_enough(const glm::dvec3& p) {
  return std::abs(p.x) <= furthest && std::abs(p.y) <= furthest && std::abs(p.z) <= furthest;  // false for NaN
}

glm::vec3 world_position(const scene::PosedSurface& surface, std::uint32_t vertex) {
  return {surface.world * glm::vec4(surface.positions[vertex], 1.0f)};
}

std::size_t triangle_count(const scene::PosedSurface& surface) {
  return surface.primitive->topology == scene::Topology::triangles ? surface.primitive->indices.size() / 3 : 0;
}

std::optional<Corners> world_triangle(const scene::PosedSurface& surface, std::size_t triangle) {
  if (triangle >= triangle_count(surface)) return {};
  const std::uint32_t* indices = &surface.primitive->indices[3 * triangle];
  const Corners corners = {glm::dvec3(world_position(surface, indices[0])),
                           glm::dvec3(world_position(surface, indices[1])),
                           glm::dvec3(world_position(surface, indices[2]))};
  if (!near_enough(corners[0]) || !near_enough(corners[1]) || !near_enough(corners[2])) return {};
  if (glm::cross(corners[1] - corners[0], corners[2] - corners[0]) == glm::dvec3(0)) return {};
  return corners;
}

}  // namespace penumbra::truth
