#include "scene/drawn.h"

#include <algorithm>
#include <vector>

#include "scene/pose.h"

namespace penumbra::scene {

Drawn count_drawn(const Scene& scene) {
  Drawn counts;
  const std::vector<bool> drawn = drawn_nodes(scene);
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const Node& node = scene.nodes[i];
    if (!drawn[i] || node.mesh < 0) continue;
    const std::size_t copies = std::max<std::size_t>(node.instances.size(), 1);
    for (const Primitive& primitive : scene.meshes[static_cast<std::size_t>(node.mesh)].primitives) {
      counts.instances += copies;
      if (primitive.topology == Topology::triangles) counts.triangles += primitive.indices.size() / 3 * copies;
      if (node.skin >= 0 || !primitive.targets.empty()) counts.deformed_vertices += primitive.positions.size();
    }
  }
  return counts;
}

}  // namespace penumbra::scene
