#pragma once

#include <cmath>

namespace penumbra::scene {

// The inverse of glsl::srgb_encode() of glsl/lib/tone_map.glsl.
inline float srgb_decode(float v) { return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f); }

}  // namespace penumbra::scene
