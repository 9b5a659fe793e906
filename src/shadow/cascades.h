#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "volume.h"

namespace penumbra::shadow {

constexpr int max_cascades = 8;

// Light space: metres, origin at `anchor` (the camera, so that floats stay exact near it), axes the rows of
// `world_to_light`: x and y across the light, z along its rays, growing away from the light. It is left-handed: the
// matrix is orthogonal with determinant -1.

// One square of a shadow map. The map's depth is linear: 0 at near_z, 1 at far_z.
struct Cascade {
  glm::vec2 center{0};    // light space, metres; a whole number of texels from the world's origin
  float half_extent = 1;  // of the whole map, metres
  float near_z = 0;       // before every caster that can reach the cascade: depths are never clamped
  float far_z = 1;
  glm::dmat4 world_to_clip{1};  // x, y in -1..1, z in 0..1
};

// The cascades of a directional light, finest first. Each holds all of the view's frustum up to its range, so a
// receiver whose disc leaves one cascade finds it whole in a coarser one.
struct Cascades {
  glm::dmat3 world_to_light{1};
  glm::dvec3 anchor{0};
  int size = 0;  // texels along a side
  std::vector<Cascade> items;

  float texel(int index) const {
    return 2.0f * items[static_cast<size_t>(index)].half_extent / static_cast<float>(size);
  }
};

struct CascadeInputs {
  glm::mat4 view{1};            // world to view, right-handed, -Z forward
  glm::mat4 projection{1};      // perspective or orthographic; its depth convention does not matter here
  glm::vec3 to_light{0, 1, 0};  // unit, world
  float tan_half_angle = 0;     // of the light; a wide light under high casters widens the last map
  Box casters;                  // all that may cast
  Box receivers;                // all that may receive; limits the last cascade's range
  int count = 4;
  int size = 2048;
  float split_blend = 0.75f;  // 0 uniform, 1 logarithmic (Zhang 2006, parallel-split shadow maps, eq. 3)
  float distance = 0;         // range of the last cascade, metres; 0: what the view sees of the receivers
};

Cascades fit_cascades(const CascadeInputs& inputs);

// The column over a cascade's map, open towards the light. A receiver whose disc leaves the map reads a coarser
// cascade, and the last map is fitted to the frustum's part widened by the light's cone, as far up as casters are: it
// holds the discs of all receivers. So a caster outside the column can't matter.
CullVolume cull_volume(const Cascades& cascades, int index);

}  // namespace penumbra::shadow
