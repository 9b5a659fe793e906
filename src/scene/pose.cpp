#include "scene/pose.h"

#include <cmath>

#include "scene/animation.h"

namespace penumbra::scene {
namespace {

// The properties of a node that animation changes.
struct Local {
  Transform transform;
  std::vector<float> weights;
};

// Products of animated transforms can exceed float's range; such a node is collapsed to a point.
glm::mat4 finite_or_collapsed(const glm::mat4& matrix) {
  for (glm::length_t c = 0; c < 4; ++c)
    for (glm::length_t r = 0; r < 4; ++r)
      if (!std::isfinite(matrix[c][r])) return {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1};
  return matrix;
}

std::vector<Local> rest_locals(const Scene& scene) {
  std::vector<Local> locals(scene.nodes.size());
  for (std::size_t i = 0; i < locals.size(); ++i) {
    const Node& node = scene.nodes[i];
    locals[i].transform = node.transform;
    if (node.mesh < 0) continue;
    const Mesh& mesh = scene.meshes[static_cast<std::size_t>(node.mesh)];
    locals[i].weights = node.weights.empty() ? mesh.default_weights : node.weights;
  }
  return locals;
}

void apply(const AnimationChannel& channel, double time, Local& local) {
  std::vector<float> value = sample(channel, time);
  for (float& v : value)
    if (!std::isfinite(v)) v = 0;
  switch (channel.path) {
    case Path::translation:
      local.transform.translation = {value[0], value[1], value[2]};
      break;
    case Path::rotation:
      local.transform.rotation = glm::quat(value[3], value[0], value[1], value[2]);
      break;
    case Path::scale:
      local.transform.scale = {value[0], value[1], value[2]};
      break;
    case Path::weights:
      local.weights = std::move(value);
      break;
  }
}

// From the roots of the forest downwards, without recursion, because hierarchies can be deep.
void place_nodes(const Scene& scene, const std::vector<Local>& locals, Pose& pose) {
  pose.world.assign(scene.nodes.size(), glm::mat4(1));
  std::vector<int> open;
  for (std::size_t i = 0; i < scene.nodes.size(); ++i)
    if (scene.nodes[i].parent < 0) open.push_back(static_cast<int>(i));
  while (!open.empty()) {
    const auto i = static_cast<std::size_t>(open.back());
    open.pop_back();
    const Node& node = scene.nodes[i];
    const glm::mat4 local = node.matrix ? *node.matrix : to_matrix(locals[i].transform);
    const glm::mat4 parent = node.parent < 0 ? glm::mat4(1) : pose.world[static_cast<std::size_t>(node.parent)];
    pose.world[i] = finite_or_collapsed(parent * local);
    open.insert(open.end(), node.children.begin(), node.children.end());
  }
}

void place_joints(const Scene& scene, Pose& pose) {
  pose.skin.resize(scene.nodes.size());
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    if (scene.nodes[i].skin < 0) continue;
    const Skin& skin = scene.skins[static_cast<std::size_t>(scene.nodes[i].skin)];
    for (std::size_t j = 0; j < skin.joints.size(); ++j)
      pose.skin[i].push_back(
          finite_or_collapsed(pose.world[static_cast<std::size_t>(skin.joints[j])] * skin.inverse_bind[j]));
  }
}

Pose make_pose(const Scene& scene, std::vector<Local> locals) {
  Pose pose;
  place_nodes(scene, locals, pose);
  pose.drawn = drawn_nodes(scene);
  place_joints(scene, pose);
  for (Local& local : locals) pose.weights.push_back(std::move(local.weights));
  return pose;
}

}  // namespace

glm::mat4 to_matrix(const Transform& transform) {
  glm::mat4 matrix = glm::mat4_cast(transform.rotation);
  for (glm::length_t c = 0; c < 3; ++c) matrix[c] *= transform.scale[c];
  matrix[3] = glm::vec4(transform.translation, 1);
  return matrix;
}

Transform to_transform(const glm::mat4& matrix) {
  Transform transform;
  transform.translation = glm::vec3(matrix[3]);
  glm::mat3 axes(matrix);
  for (glm::length_t c = 0; c < 3; ++c) transform.scale[c] = glm::length(axes[c]);
  // A mirroring matrix is a rotation with one axis negated.
  if (glm::determinant(axes) < 0) transform.scale.x = -transform.scale.x;
  for (glm::length_t c = 0; c < 3; ++c) {
    if (transform.scale[c] == 0) return transform;  // singular: the rotation is undefined
    axes[c] /= transform.scale[c];
  }
  transform.rotation = glm::normalize(glm::quat_cast(axes));
  return transform;
}

std::vector<bool> drawn_nodes(const Scene& scene) {
  std::vector<bool> drawn(scene.nodes.size(), false);
  std::vector<int> open = scene.roots;
  while (!open.empty()) {
    const auto i = static_cast<std::size_t>(open.back());
    open.pop_back();
    drawn[i] = true;
    open.insert(open.end(), scene.nodes[i].children.begin(), scene.nodes[i].children.end());
  }
  return drawn;
}

Pose rest_pose(const Scene& scene) { return make_pose(scene, rest_locals(scene)); }

Pose pose_at(const Scene& scene, double seconds) {
  std::vector<Local> locals = rest_locals(scene);
  for (const std::size_t i : played_animations(scene)) {
    const Animation& animation = scene.animations[i];
    const double time = looped_time(seconds, animation.duration);
    for (const AnimationChannel& channel : animation.channels)
      apply(channel, time, locals[static_cast<std::size_t>(channel.node)]);
  }
  return make_pose(scene, std::move(locals));
}

}  // namespace penumbra::scene
