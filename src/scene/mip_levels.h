#pragma once

#include <cstdint>
#include <vector>

#include "scene/scene.h"

namespace penumbra::scene {

// A smaller version of an image, in its format.
struct MipLevel {
  int width = 1, height = 1;
  std::vector<std::uint8_t> rgba;
};

// The mip levels of an image below the image itself, down to 1 × 1: each half as large as the one before, rounded down.
// Each texel is the mean of the area that it covers of the level before, also where that area holds parts of texels.
// `srgb`: colours are sRGB, and their light is averaged; alpha is linear in any case.
std::vector<MipLevel> mip_levels(const Image& image, bool srgb);

}  // namespace penumbra::scene
