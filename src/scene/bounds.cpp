#include <algorithm>
#include <cmath>
#include <map>

#include "scene/pose.h"

namespace penumbra::scene {
namespace {

// Up to this many vertices are transformed one by one; of further primitives only the corners of their boxes.
constexpr std::size_t most_exact = 2'000'000;

glm::vec3 transformed(const glm::mat4& matrix, const glm::vec3& point) { return {matrix * glm::vec4(point, 1)}; }

glm::vec3 morphed(const Primitive& primitive, const std::vector<float>& weights, std::size_t vertex) {
  glm::vec3 position = primitive.positions[vertex];
  for (std::size_t t = 0; t < primitive.targets.size(); ++t)
    if (weights[t] != 0 && !primitive.targets[t].positions.empty())
      position += weights[t] * primitive.targets[t].positions[vertex];
  return position;
}

glm::vec3 skinned(const Primitive& primitive, const std::vector<glm::mat4>& joints, std::size_t vertex,
                  const glm::vec3& position) {
  glm::vec3 sum(0);
  for (glm::length_t c = 0; c < 4; ++c)
    if (const float weight = primitive.weights[vertex][c]; weight != 0)
      sum += weight * transformed(joints[primitive.joints[vertex][c]], position);
  return sum;
}

Bounds box_of(const std::vector<glm::vec3>& points) {
  Bounds box;
  for (const glm::vec3& point : points) box.add(point);
  return box;
}

std::vector<glm::vec3> corners(const Bounds& box) {
  std::vector<glm::vec3> points;
  points.reserve(8);
  for (int i = 0; i < 8; ++i)
    points.emplace_back((i & 1) != 0 ? box.max.x : box.min.x, (i & 2) != 0 ? box.max.y : box.min.y,
                        (i & 4) != 0 ? box.max.z : box.min.z);
  return points;
}

// Bounding boxes of a primitive's positions and of each morph target's offsets.
struct Boxes {
  Bounds positions;
  std::vector<Bounds> offsets;
};

class Bounder {
 public:
  Bounder(const Scene& scene, const Pose& pose) : scene_(scene), pose_(pose) {}

  Bounds bounds() {
    Bounds triangles, others;
    for (std::size_t i = 0; i < scene_.nodes.size(); ++i) {
      const Node& node = scene_.nodes[i];
      if (!pose_.drawn[i] || node.mesh < 0) continue;
      for (const Primitive& primitive : scene_.meshes[static_cast<std::size_t>(node.mesh)].primitives)
        (primitive.topology == Topology::triangles ? triangles : others).add(primitive_bounds(primitive, node, i));
    }
    return triangles.empty ? others : triangles;
  }

  std::vector<Bounds> of_nodes() {
    std::vector<Bounds> all(scene_.nodes.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Node& node = scene_.nodes[i];
      if (!pose_.drawn[i] || node.mesh < 0) continue;
      for (const Primitive& primitive : scene_.meshes[static_cast<std::size_t>(node.mesh)].primitives)
        if (primitive.topology == Topology::triangles) all[i].add(primitive_bounds(primitive, node, i));
    }
    return all;
  }

 private:
  Bounds primitive_bounds(const Primitive& primitive, const Node& node, std::size_t index) {
    const bool is_skinned = node.skin >= 0 && !primitive.joints.empty();
    const std::vector<glm::mat4> matrices = is_skinned ? pose_.skin[index] : placements(node, pose_.world[index]);
    const std::size_t transforms = primitive.positions.size() * (is_skinned ? 1 : matrices.size());
    const bool exact = transforms <= most_exact - spent_;
    if (exact) spent_ += transforms;
    std::vector<glm::vec3> points;
    if (exact)
      for (std::size_t v = 0; v < primitive.positions.size(); ++v)
        points.push_back(morphed(primitive, pose_.weights[index], v));
    else
      points = corners(morphed_box(primitive, pose_.weights[index]));

    Bounds bounds;
    if (exact && is_skinned) {
      for (std::size_t v = 0; v < points.size(); ++v) bounds.add(skinned(primitive, matrices, v, points[v]));
    } else {  // a skinned vertex is a weighted mean of its positions under each joint
      for (const glm::mat4& matrix : matrices)
        for (const glm::vec3& point : points) bounds.add(transformed(matrix, point));
    }
    return bounds;
  }

  static std::vector<glm::mat4> placements(const Node& node, const glm::mat4& world) {
    if (node.instances.empty()) return {world};
    std::vector<glm::mat4> matrices;
    for (const Transform& instance : node.instances) matrices.push_back(world * to_matrix(instance));
    return matrices;
  }

  // A box that contains the morphed primitive: every target at its own extremes.
  Bounds morphed_box(const Primitive& primitive, const std::vector<float>& weights) {
    const auto [found, is_new] = boxes_.try_emplace(&primitive);
    Boxes& boxes = found->second;
    if (is_new) {
      boxes.positions = box_of(primitive.positions);
      for (const MorphTarget& target : primitive.targets) boxes.offsets.push_back(box_of(target.positions));
    }
    Bounds box = boxes.positions;
    for (std::size_t t = 0; t < boxes.offsets.size(); ++t) {
      const glm::vec3 a = weights[t] * boxes.offsets[t].min, b = weights[t] * boxes.offsets[t].max;
      box.min += glm::min(a, b);
      box.max += glm::max(a, b);
    }
    return box;
  }

  const Scene& scene_;
  const Pose& pose_;
  std::size_t spent_ = 0;
  std::map<const Primitive*, Boxes> boxes_;
};

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

Bounds bounds_of(const Scene& scene, const Pose& pose) { return Bounder(scene, pose).bounds(); }

std::vector<Bounds> node_bounds(const Scene& scene, const Pose& pose) { return Bounder(scene, pose).of_nodes(); }

}  // namespace penumbra::scene
