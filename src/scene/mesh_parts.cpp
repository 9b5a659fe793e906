#include "scene/mesh_parts.h"

#include <algorithm>

namespace penumbra::scene {

namespace {

constexpr std::size_t least_triangles = 64;  // in a part, so that no draw is too small to be worth its cost
constexpr std::size_t most_parts = 64;

}  // namespace

std::vector<MeshPart> parts_of(const Primitive& primitive) {
  std::vector<MeshPart> parts;
  const std::size_t triangles = primitive.indices.size() / 3;
  if (primitive.topology != Topology::triangles || triangles < 2 * least_triangles) return parts;
  const std::size_t step = 3 * std::max(least_triangles, (triangles + most_parts - 1) / most_parts);
  for (std::size_t first = 0; first < 3 * triangles; first += step) {
    MeshPart part{.first_index = static_cast<std::uint32_t>(first),
                  .index_count = static_cast<std::uint32_t>(std::min(step, 3 * triangles - first))};
    for (std::size_t i = first; i < first + part.index_count; ++i)
      part.box.add(primitive.positions[primitive.indices[i]]);
    parts.push_back(part);
  }
  return parts;
}

}  // namespace penumbra::scene
