#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "scene/scene.h"

namespace penumbra::scene {

// The scene at a moment: what animation, hierarchy and skins make of it. All entries are finite.
struct Pose {
  std::vector<glm::mat4> world;             // per node
  std::vector<std::vector<float>> weights;  // per node: morph weights (empty without targets)
  // Per node with a skin: world-space joint matrices (world of joint × inverse bind). They stand in for the node's own
  // world matrix, which glTF ignores for skinned meshes.
  std::vector<std::vector<glm::mat4>> skin;
  std::vector<bool> drawn;  // per node: reachable from the scene's roots
};

// Which nodes the scene's roots reach.
std::vector<bool> drawn_nodes(const Scene& scene);

// The pose without animation.
Pose rest_pose(const Scene& scene);

// The pose at `seconds`, the file's animations played together, each looped over its own duration; with none, the rest
// pose. At an animation's end its last key holds, and the loop starts after it. An animation that drives something an
// earlier one drives already is left out: a file with many clips for one skeleton plays its first.
Pose pose_at(const Scene& scene, double seconds);

struct Bounds {
  glm::vec3 min{0}, max{0};
  bool empty = true;
  void add(const glm::vec3& point);
  void add(const Bounds& other);
  glm::vec3 center() const { return (min + max) * 0.5f; }
  glm::vec3 extent() const { return max - min; }
  float radius() const;  // of the sphere about the box
};

// World bounds of all drawn triangles (deformed and instanced), points and lines included only when there are no
// triangles. Exact up to two million vertices; what goes beyond is bounded by boxes.
Bounds bounds_of(const Scene& scene, const Pose& pose);

// The same of each node by itself, triangles only; empty: it draws none.
std::vector<Bounds> node_bounds(const Scene& scene, const Pose& pose);

// A transform as a matrix, and the transform nearest to a matrix (shear is lost).
glm::mat4 to_matrix(const Transform& transform);
Transform to_transform(const glm::mat4& matrix);

}  // namespace penumbra::scene
