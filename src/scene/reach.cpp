#include "scene/reach.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace penumbra::scene {
namespace {

double furthest_of(const std::vector<glm::vec3>& points) {
  double furthest = 0;
  for (const glm::vec3& point : points)
    for (glm::length_t c = 0; c < 3; ++c) furthest = std::max<double>(furthest, std::abs(point[c]));
  return furthest;
}

double furthest_of(const std::vector<glm::mat4>& worlds) {
  double furthest = 0;
  for (const glm::mat4& world : worlds)
    for (glm::length_t c = 0; c < 4; ++c)
      for (glm::length_t r = 0; r < 3; ++r) furthest = std::max<double>(furthest, std::abs(world[c][r]));
  return furthest;
}

// The most by which the matrix without its translation enlarges the largest coordinate of a point.
double stretch_of(const glm::mat4& matrix) {
  double stretch = 0;
  for (glm::length_t r = 0; r < 3; ++r) {
    double sum = 0;
    for (glm::length_t c = 0; c < 3; ++c) sum += std::abs(double{matrix[c][r]});
    stretch = std::max(stretch, sum);
  }
  return stretch;
}

double shift_of(const glm::mat4& matrix) {
  double shift = 0;
  for (glm::length_t r = 0; r < 3; ++r) shift = std::max<double>(shift, std::abs(matrix[3][r]));
  return shift;
}

}  // namespace

double reach_of(const Scene& scene, const Pose& pose) {
  const Bounds bounds = bounds_of(scene, pose);
  double furthest = furthest_of(pose.world);
  for (const glm::vec3& corner : {bounds.min, bounds.max})
    for (glm::length_t c = 0; c < 3; ++c)
      furthest = std::isfinite(corner[c]) ? std::max<double>(furthest, std::abs(corner[c])) : HUGE_VAL;
  return furthest;
}

ReachBound::ReachBound(const Scene& scene) {
  for (const Mesh& mesh : scene.meshes) meshes_.push_back(reach_of_mesh(mesh));
  for (const Node& node : scene.nodes) nodes_.push_back(reach_of_node(node));
}

ReachBound::MeshReach ReachBound::reach_of_mesh(const Mesh& mesh) {
  MeshReach reach;
  for (const Primitive& primitive : mesh.primitives) {
    reach.positions = std::max(reach.positions, furthest_of(primitive.positions));
    reach.targets.resize(std::max(reach.targets.size(), primitive.targets.size()));
    for (std::size_t t = 0; t < primitive.targets.size(); ++t)
      reach.targets[t] = std::max(reach.targets[t], furthest_of(primitive.targets[t].positions));
  }
  return reach;
}

ReachBound::NodeReach ReachBound::reach_of_node(const Node& node) {
  NodeReach reach{.mesh = node.mesh};
  for (const Transform& instance : node.instances) {
    const glm::mat4 matrix = to_matrix(instance);
    reach.shift = std::max(reach.shift, shift_of(matrix));
    reach.stretch = std::max(reach.stretch, stretch_of(matrix));
  }
  return reach;
}

double ReachBound::at(const Pose& pose) const {
  double furthest = furthest_of(pose.world);
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const NodeReach& node = nodes_[i];
    if (node.mesh < 0 || !pose.drawn[i]) continue;
    const MeshReach& mesh = meshes_[static_cast<std::size_t>(node.mesh)];
    double local = mesh.positions;
    for (std::size_t t = 0; t < mesh.targets.size(); ++t) local += std::abs(pose.weights[i][t]) * mesh.targets[t];
    local = node.shift + node.stretch * local;
    furthest = std::max(furthest, shift_of(pose.world[i]) + stretch_of(pose.world[i]) * local);
    // A skinned vertex is a weighted mean of its positions under each joint.
    for (const glm::mat4& joint : pose.skin[i])
      furthest = std::max(furthest, shift_of(joint) + stretch_of(joint) * local);
  }
  return furthest;
}

std::string over_extent(double reach, double limit) {
  return fmt::format("reaches {:.3g} m from the origin, over the limit of {:.3g} m", reach, limit);
}

}  // namespace penumbra::scene
