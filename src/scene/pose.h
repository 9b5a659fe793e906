#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "scene/scene.h"

namespace penumbra::scene {

// The scene at one time: the result of animation, hierarchy and skinning. All values are finite.
struct Pose {
  std::vector<glm::mat4> world;             // per node
  std::vector<std::vector<float>> weights;  // per node: morph weights (empty without morph targets)
  // Per node with a skin: world-space joint matrices (world of joint × inverse bind). They replace the node's own world
  // matrix, which glTF ignores for skinned meshes.
  std::vector<std::vector<glm::mat4>> skin;
  std::vector<bool> drawn;  // per node: reachable from the scene's roots
};

// Whether each node is reachable from the scene's roots.
std::vector<bool> drawn_nodes(const Scene& scene);

// The pose without animation.
Pose rest_pose(const Scene& scene);

// The pose at `seconds`. All animations of the file play at once, each looped over its own duration; without animations
// it is the rest pose. At exactly an animation's end its last key applies, and the loop restarts after it. An animation
// that drives a property which an earlier one already drives is not played: of a file with many clips for one skeleton
// only the first plays.
Pose pose_at(const Scene& scene, double seconds);

struct Bounds {
  glm::vec3 min{0}, max{0};
  bool empty = true;
  void add(const glm::vec3& point);
  void add(const Bounds& other);
  glm::vec3 center() const { return (min + max) * 0.5f; }
  glm::vec3 extent() const { return max - min; }
  float radius() const;  // of the bounding box's circumscribed sphere
};

// World bounds of all drawn triangles (deformed and instanced); points and lines count only if there are no triangles.
// Exact up to two million vertices; the primitives beyond are bounded by their transformed boxes.
Bounds bounds_of(const Scene& scene, const Pose& pose);

// The same for each node separately, triangles only; empty if the node draws none.
std::vector<Bounds> node_bounds(const Scene& scene, const Pose& pose);

// A transform as a matrix, and the transform nearest to a matrix (shear is lost).
glm::mat4 to_matrix(const Transform& transform);
Transform to_transform(const glm::mat4& matrix);

}  // namespace penumbra::scene
