// Where the table of the sky holds a direction: x grows from the side of the horizon where the sun is to the other, y
// from the horizon to the zenith. Both sides of the sun's plane are alike. The horizon has more room, and no angle is
// computed.
#ifndef PENUMBRA_SKY_MAP_GLSL
#define PENUMBRA_SKY_MAP_GLSL

#include "shared/language.h"

GLSL_BEGIN

// A direction to a place in the table, 0 to 1. Below the horizon: the horizon's. `sun_side`: x and z of a unit vector.
GLSL_FUNCTION vec2 sky_place(vec3 direction, vec2 sun_side) {
  vec2 level = vec2(direction.x, direction.z);
  float toward = dot(level, sun_side) * inversesqrt(max(dot(level, level), 1e-12f));
  float height = clamp(direction.y, 0.0f, 1.0f);
  return vec2(sqrt(max(0.5f - 0.5f * toward, 0.0f)), sqrt(1.0f - sqrt(1.0f - height)));
}

// And back, to a unit vector.
GLSL_FUNCTION vec3 sky_direction(vec2 place, vec2 sun_side) {
  float below = 1.0f - place.y * place.y;
  float height = 1.0f - below * below, level = sqrt(max(1.0f - height * height, 0.0f));
  float toward = 1.0f - 2.0f * place.x * place.x, across = sqrt(max(1.0f - toward * toward, 0.0f));
  vec2 side = toward * sun_side + across * vec2(-sun_side.y, sun_side.x);
  return vec3(level * side.x, height, level * side.y);
}

// How much a direction by its height, the sine of its elevation, has of the horizon's light where surfaces mirror it.
GLSL_FUNCTION float low_sky(float height) {
  float low = 1.0f - clamp(height, 0.0f, 1.0f);
  low *= low;
  return low * low;
}

GLSL_END

#endif
