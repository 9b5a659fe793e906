#pragma once

#include <vector>

#include "cascades.h"

namespace penumbra::shadow {

// What a cascade contains in light space, without margins: a column about `center` with these depths.
struct Region {
  glm::dvec3 center{0};
  glm::dvec2 half_width{0};
  double shallowest = 0, deepest = 0;
};

// One for each cascade, finest first: about what the view shows of the receivers, or of those that a penumbra may
// reach, up to its range; the last one about all receivers. Chooses how many there are, and in `cascades`, which has
// its anchor, how light space is turned and the maps' size.
std::vector<Region> visible_regions(const CascadeInputs& inputs, Cascades& cascades);

}  // namespace penumbra::shadow
