#pragma once

#include <vector>

#include "light_work.h"

namespace penumbra::shadow {

// What a light's technique, its stand-in and its denoiser need in this frame, directly or through the recipes that they
// need.
struct Wanted {
  bool shadow_map = false;
  std::vector<const Recipe*> recipes;  // in the order in which they are made
};
Wanted wanted_of(const LightWork& work);

// The layers of the shadow map that are the same as in the last frame, if the recipe made a texture in that frame and
// nothing else that it depends on changed; else none.
LayerSet unchanged_layers(const LightWork& work, const Recipe& recipe);

// Makes the products, each by its own passes, or keeps those of the last frame.
void build_products(const LightWork& work, const std::vector<const Recipe*>& recipes);

}  // namespace penumbra::shadow
