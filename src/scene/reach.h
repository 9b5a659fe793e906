#pragma once

#include <string>
#include <vector>

#include "scene/pose.h"
#include "scene/scene.h"

namespace penumbra::scene {

// How far the scene reaches from the origin in a pose, metres: its bounds, and all nodes with their axes. Infinite
// where float's range is left.
double reach_of(const Scene& scene, const Pose& pose);

// An upper bound of reach_of() that takes no time for vertices, for each frame of an animation.
class ReachBound {
 public:
  ReachBound() = default;
  explicit ReachBound(const Scene& scene);

  // In a pose of the scene.
  double at(const Pose& pose) const;

 private:
  // The largest coordinates of a mesh, and of the offsets of each of its morph targets.
  struct MeshReach {
    double positions = 0;
    std::vector<double> targets;
  };
  // The node's instances move the mesh's coordinates by no more than `shift` and enlarge them by no more than
  // `stretch`.
  struct NodeReach {
    int mesh = -1;
    double shift = 0, stretch = 1;
  };

  static MeshReach reach_of_mesh(const Mesh& mesh);
  static NodeReach reach_of_node(const Node& node);

  std::vector<MeshReach> meshes_;
  std::vector<NodeReach> nodes_;
};

// "reaches 1e+37 m from the origin, over the limit of 1e+09 m"
std::string over_extent(double reach, double limit);

}  // namespace penumbra::scene
