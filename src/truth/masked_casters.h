#pragma once

#include <span>
#include <vector>

#include "scene/posed_geometry.h"
#include "shadow/light_projection.h"

namespace penumbra::truth {

// Where casters with an alpha mask lie in a light's shadow map. What is left of them by the mask is often narrower than
// a texel, so that it falls between the map's samples and the map has no edge there.
struct MaskedCasters {
  // For each layer, levels of squares: the least stored depth (0 to 1; 1: no such caster) of blocks of 4 · 2^level
  // texels squared, in rows. Level 0 has `side` squared, each further level half of that, the last one.
  std::vector<std::vector<std::vector<float>>> layers;
  int side = 0;  // 0: there is none in any layer

  static MaskedCasters of(const scene::PosedGeometry& geometry, const shadow::LightProjection& projection);
};

}  // namespace penumbra::truth
