#pragma once

#include <cstddef>

#include "scene/scene.h"

namespace penumbra::scene {

// The memory that GpuScene takes, bytes: vertices, indices and triangle normals of all that is drawn, with two poses of
// what deforms, the vertices, morph targets and joint weights that these follow from; and the images that materials
// use, with their mip levels. Drivers may round up.
std::size_t gpu_vertex_bytes(const Scene& scene);
std::size_t gpu_texture_bytes(const Scene& scene);

}  // namespace penumbra::scene
