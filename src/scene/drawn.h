#pragma once

#include <cstddef>

#include "scene/scene.h"

namespace penumbra::scene {

// What a frame draws of a scene: a primitive of a node is drawn once for each place of the node.
struct Drawn {
  std::size_t instances = 0, triangles = 0;
  std::size_t deformed_vertices = 0;  // of skinned and morphed meshes: each node that draws one has its own
};

Drawn count_drawn(const Scene& scene);

}  // namespace penumbra::scene
