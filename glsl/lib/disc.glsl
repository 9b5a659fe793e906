#ifndef PENUMBRA_DISC_GLSL
#define PENUMBRA_DISC_GLSL

#include "shared/language.h"

GLSL_BEGIN

// The unit square onto the unit disc, equal areas to equal areas, with little distortion (Shirley and Chiu 1997, "A low
// distortion map between disk and square").
GLSL_FUNCTION vec2 concentric_disc(vec2 u) {
  vec2 p = 2.0f * u - vec2(1.0f);
  bool wide = abs(p.x) > abs(p.y);
  float radius = wide ? p.x : p.y;
  float ratio = radius == 0.0f ? 0.0f : (wide ? p.y : p.x) / radius;
  // Taylor series, for speed, as this runs for every tap; error at most 4e-7.
  float angle = 0.78539816f * ratio;
  float x = angle * angle;
  float c = 1.0f + x * (-0.5f + x * (4.1666667e-2f + x * (-1.3888889e-3f + x * 2.4801587e-5f)));
  float s = angle * (1.0f + x * (-0.16666667f + x * (8.3333333e-3f - x * 1.9841270e-4f)));
  return wide ? vec2(radius * c, radius * s) : vec2(radius * s, radius * c);
}

// Cranley and Patterson 1976: a point set shifted on the torus.
GLSL_FUNCTION vec2 toroidal_shift(vec2 point, vec2 shift) {
  vec2 p = point + shift;
  return vec2(p.x >= 1.0f ? p.x - 1.0f : p.x, p.y >= 1.0f ? p.y - 1.0f : p.y);
}

GLSL_END

#endif
