#include "scene/geometry.h"

#include <cmath>
#include <utility>

namespace penumbra::scene {
namespace {

constexpr glm::vec3 up{0, 1, 0};

// In double precision: products of large or tiny coordinates exceed float's range.
glm::vec3 unit_or(const glm::dvec3& vector, const glm::vec3& otherwise) {
  const double length = glm::length(vector);
  return length > 0 && std::isfinite(length) ? glm::vec3(vector / length) : otherwise;
}

glm::dvec3 area_normal(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  const glm::dvec3 origin(a);
  return glm::cross(glm::dvec3(b) - origin, glm::dvec3(c) - origin);
}

glm::vec3 any_orthogonal(const glm::vec3& normal) {
  const glm::vec3 axis = std::abs(normal.x) < 0.9f ? glm::vec3(1, 0, 0) : glm::vec3(0, 0, 1);
  return unit_or(glm::cross(glm::dvec3(axis), glm::dvec3(normal)), glm::vec3(1, 0, 0));
}

template <class T>
void gather(std::vector<T>& values, std::span<const uint32_t> indices) {
  if (values.empty()) return;
  std::vector<T> gathered;
  gathered.reserve(indices.size());
  for (const uint32_t index : indices) gathered.push_back(values[index]);
  values = std::move(gathered);
}

// Gives each index its own vertex.
void split_vertices(Primitive& primitive) {
  const std::span<const uint32_t> indices = primitive.indices;
  gather(primitive.positions, indices);
  gather(primitive.normals, indices);
  gather(primitive.tangents, indices);
  for (auto& uvs : primitive.uvs) gather(uvs, indices);
  gather(primitive.colors, indices);
  gather(primitive.joints, indices);
  gather(primitive.weights, indices);
  for (MorphTarget& target : primitive.targets) {
    gather(target.positions, indices);
    gather(target.normals, indices);
    gather(target.tangents, indices);
  }
  for (std::size_t i = 0; i < primitive.indices.size(); ++i) primitive.indices[i] = static_cast<uint32_t>(i);
}

// The flat normals of a primitive whose vertices are the triangles' corners in order.
std::vector<glm::vec3> flat_normals(std::span<const glm::vec3> corners) {
  std::vector<glm::vec3> normals;
  normals.reserve(corners.size());
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
    normals.insert(normals.end(), 3, unit_or(area_normal(corners[i], corners[i + 1], corners[i + 2]), up));
  return normals;
}

struct TangentSums {
  std::vector<glm::dvec3> tangents, bitangents;
};

TangentSums sum_tangents(const Primitive& primitive, const std::vector<glm::vec2>& uvs) {
  const std::size_t count = primitive.positions.size();
  TangentSums sums{std::vector<glm::dvec3>(count, glm::dvec3(0)), std::vector<glm::dvec3>(count, glm::dvec3(0))};
  for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
    const uint32_t* corner = &primitive.indices[i];
    const glm::dvec3 edge1 = glm::dvec3(primitive.positions[corner[1]]) - glm::dvec3(primitive.positions[corner[0]]);
    const glm::dvec3 edge2 = glm::dvec3(primitive.positions[corner[2]]) - glm::dvec3(primitive.positions[corner[0]]);
    const glm::dvec2 uv1 = glm::dvec2(uvs[corner[1]]) - glm::dvec2(uvs[corner[0]]);
    const glm::dvec2 uv2 = glm::dvec2(uvs[corner[2]]) - glm::dvec2(uvs[corner[0]]);
    const double sign = uv1.x * uv2.y - uv2.x * uv1.y < 0 ? -1 : 1;
    // Weighted by the triangle's area in space, not in the texture: hence the unit vectors.
    const double area = glm::length(glm::cross(edge1, edge2));
    const glm::dvec3 along_u = glm::dvec3(unit_or((edge1 * uv2.y - edge2 * uv1.y) * sign, glm::vec3(0))) * area;
    const glm::dvec3 along_v = glm::dvec3(unit_or((edge2 * uv1.x - edge1 * uv2.x) * sign, glm::vec3(0))) * area;
    for (int k = 0; k < 3; ++k) {
      sums.tangents[corner[k]] += along_u;
      sums.bitangents[corner[k]] += along_v;
    }
  }
  return sums;
}

}  // namespace

Topology expanded_topology(int mode) {
  if (mode == 0) return Topology::points;
  return mode <= 3 ? Topology::lines : Topology::triangles;
}

std::vector<uint32_t> expanded_indices(int mode, std::span<const uint32_t> in) {
  std::vector<uint32_t> out;
  const std::size_t count = in.size();
  switch (mode) {
    case 0:
      out.assign(in.begin(), in.end());
      break;
    case 1:
      out.assign(in.begin(), in.begin() + static_cast<std::ptrdiff_t>(count / 2 * 2));
      break;
    case 2:
    case 3:
      for (std::size_t i = 0; i + 1 < count; ++i) out.insert(out.end(), {in[i], in[i + 1]});
      if (mode == 2 && count > 1) out.insert(out.end(), {in[count - 1], in[0]});
      break;
    case 5:  // every second triangle of a strip has the opposite winding
      for (std::size_t i = 0; i + 2 < count; ++i) out.insert(out.end(), {in[i], in[i + 1 + i % 2], in[i + 2 - i % 2]});
      break;
    case 6:
      for (std::size_t i = 1; i + 1 < count; ++i) out.insert(out.end(), {in[i], in[i + 1], in[0]});
      break;
    default:
      out.assign(in.begin(), in.begin() + static_cast<std::ptrdiff_t>(count / 3 * 3));
  }
  return out;
}

void make_flat_normals(Primitive& primitive) {
  if (primitive.topology != Topology::triangles) {
    primitive.normals.assign(primitive.positions.size(), up);
    return;
  }
  split_vertices(primitive);
  primitive.tangents.clear();  // tangents without normals are meaningless
  primitive.normals = flat_normals(primitive.positions);
  for (MorphTarget& target : primitive.targets) {
    target.tangents.clear();
    if (target.positions.empty()) continue;
    std::vector<glm::vec3> moved = primitive.positions;
    for (std::size_t i = 0; i < moved.size(); ++i) moved[i] += target.positions[i];
    target.normals = flat_normals(moved);
    for (std::size_t i = 0; i < moved.size(); ++i) target.normals[i] -= primitive.normals[i];
  }
}

std::size_t repair_normals(Primitive& primitive) {
  std::vector<glm::dvec3> sums;
  std::size_t repaired = 0;
  for (glm::vec3& normal : primitive.normals)
    if (const glm::vec3 unit = unit_or(glm::dvec3(normal), glm::vec3(0)); unit != glm::vec3(0)) {
      normal = unit;
    } else {
      normal = glm::vec3(0);
      ++repaired;
      sums.resize(primitive.positions.size(), glm::dvec3(0));
    }
  if (sums.empty()) return 0;
  if (primitive.topology == Topology::triangles) {
    for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
      const uint32_t* corner = &primitive.indices[i];
      const glm::dvec3 normal =
          area_normal(primitive.positions[corner[0]], primitive.positions[corner[1]], primitive.positions[corner[2]]);
      for (int k = 0; k < 3; ++k) sums[corner[k]] += normal;
    }
  }
  for (std::size_t i = 0; i < sums.size(); ++i)
    if (primitive.normals[i] == glm::vec3(0)) primitive.normals[i] = unit_or(sums[i], up);
  return repaired;
}

void repair_tangents(Primitive& primitive) {
  for (std::size_t i = 0; i < primitive.tangents.size(); ++i) {
    glm::vec4& tangent = primitive.tangents[i];
    const glm::vec3 unit = unit_or(glm::dvec3(tangent), any_orthogonal(primitive.normals[i]));
    tangent = glm::vec4(unit, tangent.w < 0 ? -1 : 1);
  }
}

void make_tangents(Primitive& primitive, int uv_set, const glm::mat3x2& uv_transform) {
  std::vector<glm::vec2> uvs = primitive.uvs[static_cast<std::size_t>(uv_set)];
  if (uvs.empty()) uvs.assign(primitive.positions.size(), glm::vec2(0));
  for (glm::vec2& uv : uvs) uv = uv_transform * glm::vec3(uv, 1);
  const TangentSums sums = sum_tangents(primitive, uvs);
  primitive.tangents.resize(primitive.positions.size());
  for (std::size_t i = 0; i < primitive.tangents.size(); ++i) {
    const glm::dvec3 normal(primitive.normals[i]);
    const glm::dvec3 flattened = sums.tangents[i] - normal * glm::dot(normal, sums.tangents[i]);
    // At a seam where the texture is mirrored, the tangents of both sides cancel out.
    const bool cancelled = glm::length(flattened) < 1e-3 * glm::length(sums.bitangents[i]);
    const glm::vec3 across = unit_or(glm::cross(sums.bitangents[i], normal), any_orthogonal(primitive.normals[i]));
    const glm::vec3 tangent = cancelled ? across : unit_or(flattened, across);
    const double handedness = glm::dot(glm::cross(normal, glm::dvec3(tangent)), sums.bitangents[i]);
    primitive.tangents[i] = glm::vec4(tangent, handedness < 0 ? -1.0f : 1.0f);
  }
}

}  // namespace penumbra::scene
