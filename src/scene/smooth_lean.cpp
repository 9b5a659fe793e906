#include "scene/smooth_lean.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <unordered_map>

#include "lib/triangle_normal.glsl"

namespace penumbra::scene {

namespace {

// What a lean below this changes is less than a step of an 8-bit picture.
constexpr float least_lean = 1.0f / 510;

// The sine of the angle between two directions of any length; 0 if one of them has none.
float sine_between(const glm::vec3& a, const glm::vec3& b) {
  const float lengths = glm::length(a) * glm::length(b);
  const float sine = lengths > 0.0f ? glm::length(glm::cross(a, b)) / lengths : 0.0f;
  return sine > 0.0f ? sine : 0.0f;  // not a number: 0
}

// What a triangle adds to the lean around its corners.
float lean_of(const Primitive& primitive, std::size_t first) {
  const auto vertex = [&](std::size_t corner) { return primitive.indices[first + corner]; };
  const glm::vec3 normal = glsl::triangle_normal(primitive.positions[vertex(0)], primitive.positions[vertex(1)],
                                                 primitive.positions[vertex(2)]);
  float most = 0;
  for (std::size_t corner = 0; corner < 3; ++corner)
    most = std::max(most, sine_between(normal, primitive.normals[vertex(corner)]));
  return most * (1.0f - glm::smoothstep(0.25f, 0.5f, most));
}

// A vertex's place and normal.
using Corner = std::array<std::uint32_t, 6>;

struct CornerHash {
  std::size_t operator()(const Corner& corner) const {
    std::uint64_t hash = 0xcbf29ce484222325u;  // FNV-1a
    for (const std::uint32_t part : corner) hash = (hash ^ part) * 0x100000001b3u;
    return static_cast<std::size_t>(hash ^ hash >> 32);
  }
};

Corner corner_of(const Primitive& primitive, std::size_t vertex) {
  Corner corner{};
  for (glm::length_t i = 0; i < 3; ++i) {
    // Adding 0 makes -0 the same as 0.
    corner[static_cast<std::size_t>(i)] = std::bit_cast<std::uint32_t>(primitive.positions[vertex][i] + 0.0f);
    corner[static_cast<std::size_t>(i) + 3] = std::bit_cast<std::uint32_t>(primitive.normals[vertex][i] + 0.0f);
  }
  return corner;
}

void share_between_seams(const Primitive& primitive, std::vector<float>& leans) {
  std::unordered_map<Corner, float, CornerHash> most;
  most.reserve(leans.size());
  std::vector<const float*> of_vertices;
  of_vertices.reserve(leans.size());
  for (std::size_t i = 0; i < leans.size(); ++i) {
    float& shared = most[corner_of(primitive, i)];
    shared = std::max(shared, leans[i]);
    of_vertices.push_back(&shared);
  }
  for (std::size_t i = 0; i < leans.size(); ++i) leans[i] = *of_vertices[i];
}

}  // namespace

std::vector<float> smooth_leans(const Primitive& primitive) {
  std::vector<float> leans(primitive.positions.size(), 0.0f);
  if (primitive.topology != Topology::triangles) return leans;
  bool any = false;
  for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
    const float lean = lean_of(primitive, i);
    if (lean < least_lean) continue;
    any = true;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      float& of_vertex = leans[primitive.indices[i + corner]];
      of_vertex = std::max(of_vertex, lean);
    }
  }
  if (any) share_between_seams(primitive, leans);
  return leans;
}

}  // namespace penumbra::scene
