#ifndef PENUMBRA_OCTAHEDRAL_GLSL
#define PENUMBRA_OCTAHEDRAL_GLSL

#include "shared/language.h"

GLSL_BEGIN

// A unit vector as a point of the square -1..1 (Meyer et al. 2010, "On floating-point normal vectors").
GLSL_FUNCTION vec2 octahedral_encode(vec3 v) {
  float sum = abs(v.x) + abs(v.y) + abs(v.z);
  vec2 p = vec2(v.x / sum, v.y / sum);
  if (v.z >= 0.0f) return p;
  return vec2((1.0f - abs(p.y)) * (p.x >= 0.0f ? 1.0f : -1.0f), (1.0f - abs(p.x)) * (p.y >= 0.0f ? 1.0f : -1.0f));
}

// And back, to a vector of any length.
GLSL_FUNCTION vec3 octahedral_direction(vec2 e) {
  vec3 v = vec3(e.x, e.y, 1.0f - abs(e.x) - abs(e.y));
  float fold = max(-v.z, 0.0f);
  v.x += v.x >= 0.0f ? -fold : fold;
  v.y += v.y >= 0.0f ? -fold : fold;
  return v;
}

GLSL_FUNCTION vec3 octahedral_decode(vec2 e) { return normalize(octahedral_direction(e)); }

GLSL_END

#endif
