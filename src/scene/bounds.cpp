#include <algorithm>
#include <cmath>

#include "scene/pose.h"

namespace penumbra::scene {
namespace {

// Vertices times instances of one node beyond which the instances' boxes are bounded instead of their vertices.
constexpr std::size_t most_exact = 1'000'000;

glm::vec3 morphed(const Primitive& primitive, const std::vector<float>& weights, std::size_t vertex) {
  glm::vec3 position = primitive.positions[vertex];
  for (std::size_t t = 0; t < primitive.targets.size(); ++t)
    if (weights[t] != 0 && !primitive.targets[t].positions.empty())
      position += weights[t] * primitive.targets[t].positions[vertex];
  return position;
}

glm::vec3 transformed(const glm::mat4& matrix, const glm::vec3& point) { return {matrix * glm::vec4(point, 1)}; }

glm::vec3 skinned(const Primitive& primitive, const std::vector<glm::mat4>& joints, std::size_t vertex,
                  const glm::vec3& position) {
  glm::vec3 sum(0);
  for (glm::length_t c = 0; c < 4; ++c)
    if (const float weight = primitive.weights[vertex][c]; weight != 0)
      sum += weight * transformed(joints[primitive.joints[vertex][c]], position);
  return sum;
}

std::vector<glm::mat4> placements(const Node& node, const glm::mat4& world) {
  if (node.instances.empty()) return {world};
  std::vector<glm::mat4> matrices;
  for (const Transform& instance : node.instances) matrices.push_back(world * to_matrix(instance));
  return matrices;
}

std::vector<glm::vec3> corners(const Bounds& box) {
  std::vector<glm::vec3> points;
  for (int i = 0; i < 8; ++i)
    points.emplace_back((i & 1) != 0 ? box.max.x : box.min.x, (i & 2) != 0 ? box.max.y : box.min.y,
                        (i & 4) != 0 ? box.max.z : box.min.z);
  return points;
}

Bounds primitive_bounds(const Primitive& primitive, const Node& node, const Pose& pose, std::size_t index) {
  Bounds bounds;
  std::vector<glm::vec3> points;
  points.reserve(primitive.positions.size());
  for (std::size_t v = 0; v < primitive.positions.size(); ++v)
    points.push_back(morphed(primitive, pose.weights[index], v));
  if (node.skin >= 0 && !primitive.joints.empty()) {
    for (std::size_t v = 0; v < points.size(); ++v) bounds.add(skinned(primitive, pose.skin[index], v, points[v]));
    return bounds;
  }
  const std::vector<glm::mat4> matrices = placements(node, pose.world[index]);
  if (points.size() > most_exact / matrices.size()) {
    Bounds box;
    for (const glm::vec3& point : points) box.add(point);
    points = corners(box);
  }
  for (const glm::mat4& matrix : matrices)
    for (const glm::vec3& point : points) bounds.add(transformed(matrix, point));
  return bounds;
}

}  // namespace

void Bounds::add(const glm::vec3& point) {
  min = empty ? point : glm::min(min, point);
  max = empty ? point : glm::max(max, point);
  empty = false;
}

void Bounds::add(const Bounds& other) {
  if (other.empty) return;
  add(other.min);
  add(other.max);
}

float Bounds::radius() const { return glm::length(extent()) * 0.5f; }

Bounds bounds_of(const Scene& scene, const Pose& pose) {
  Bounds triangles, others;
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const Node& node = scene.nodes[i];
    if (!pose.drawn[i] || node.mesh < 0) continue;
    for (const Primitive& primitive : scene.meshes[static_cast<std::size_t>(node.mesh)].primitives)
      (primitive.topology == Topology::triangles ? triangles : others).add(primitive_bounds(primitive, node, pose, i));
  }
  return triangles.empty ? others : triangles;
}

}  // namespace penumbra::scene
