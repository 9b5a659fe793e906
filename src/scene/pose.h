#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "scene/scene.h"

namespace penumbra::scene {

// The scene at a moment: what animation, hierarchy and skins make of it.
struct Pose {
  std::vector<glm::mat4> world;             // per node
  std::vector<std::vector<float>> weights;  // per node: morph weights (empty without targets)
  std::vector<std::vector<glm::mat4>>
      skin;                 // per node with a skin: world-space joint matrices (world of joint × inverse bind)
  std::vector<bool> drawn;  // per node: reachable from the scene's roots
};

// The pose at `seconds`, all of the file's animations played together and looped, as glTF viewers do; with none, the
// rest pose.
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
// triangles.
Bounds bounds_of(const Scene& scene, const Pose& pose);

}  // namespace penumbra::scene
