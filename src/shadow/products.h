#pragma once

#include <vector>

#include "light_work.h"

namespace penumbra::shadow {

// What a light's technique, its stand-in and its denoiser ask for in this frame, themselves or through what they ask
// for.
struct Wanted {
  bool shadow_map = false;
  std::vector<const Recipe*> recipes;  // in the order in which they are made
};
Wanted wanted_of(const LightWork& work);

// Makes the products, each in passes of its own, and gives back those that only the last frame made.
void build_products(const LightWork& work, const std::vector<const Recipe*>& recipes);

}  // namespace penumbra::shadow
