#ifndef PENUMBRA_TONE_MAP_GLSL
#define PENUMBRA_TONE_MAP_GLSL

#include "shared/language.h"

GLSL_BEGIN

// The Academy's reference rendering and sRGB output transforms as Stephen Hill fitted them: linear Rec. 709 to linear
// display. Bright colours lose saturation as film does. Scaled so that middle grey stays in place.
GLSL_FUNCTION vec3 tone_map(vec3 color) {
  vec3 c = color * 1.45f;
  // Rec. 709 to the transform's working primaries
  vec3 v = vec3(0.59719f * c.x + 0.35458f * c.y + 0.04823f * c.z, 0.07600f * c.x + 0.90834f * c.y + 0.01566f * c.z,
                0.02840f * c.x + 0.13383f * c.y + 0.83777f * c.z);
  v = (v * (v + 0.0245786f) - 0.000090537f) / (v * (0.983729f * v + 0.4329510f) + 0.238081f);
  // and back to Rec. 709
  vec3 d = vec3(1.60475f * v.x - 0.53108f * v.y - 0.07367f * v.z, -0.10208f * v.x + 1.10813f * v.y - 0.00605f * v.z,
                -0.00327f * v.x - 0.07276f * v.y + 1.07602f * v.z);
  return clamp(d, 0.0f, 1.0f);
}

// IEC 61966-2-1.
GLSL_FUNCTION float srgb_encode(float v) {
  return v <= 0.0031308f ? 12.92f * v : 1.055f * pow(v, 1.0f / 2.4f) - 0.055f;
}

GLSL_END

#endif
