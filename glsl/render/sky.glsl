// The sky and the ground that light what the sun does not.
#include "shared/lighting_block.h"

layout(std140, binding = 5) uniform LightingData { LightingBlock lighting; };

// Radiance over its mean: deep blue overhead, pale at the horizon. The cosine-weighted mean of the mixture is a fifteenth of
// the way from zenith to horizon, and its luminance is 1.
vec3 sky_color(float height) {
  const vec3 zenith = vec3(0.44, 0.84, 1.85);
  const vec3 horizon = vec3(2.7, 3.0, 3.2);
  float low = 1.0 - clamp(height, 0.0, 1.0);
  return mix(zenith, horizon, low * low * low * low);
}

// What comes from a direction; `blur` softens the horizon.
vec3 surroundings(vec3 direction, float blur) {
  float above = smoothstep(-0.01 - blur, 0.01 + blur, direction.y);
  return mix(lighting.ground.rgb, lighting.sky.rgb * sky_color(direction.y), above);
}

// Irradiance over pi on a plane from sky and ground.
vec3 ambient(vec3 normal) {
  const vec3 mean = vec3(0.59, 0.98, 1.94);
  return mix(lighting.ground.rgb, lighting.sky.rgb * mix(vec3(1.0), mean, 0.5), 0.5 + 0.5 * normal.y);
}
