#pragma once

#include <cstddef>

#include "scene/scene.h"

namespace penumbra::scene {

// How much a frame draws of a scene: a primitive of a node is drawn once for each instance of the node.
struct Drawn {
  std::size_t instances = 0, triangles = 0;
  std::size_t deformed_vertices = 0;  // of skinned and morphed meshes, counted once for each node that draws them
};

Drawn count_drawn(const Scene& scene);

}  // namespace penumbra::scene
