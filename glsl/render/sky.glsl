// The sky, and the ground around the scene: lighting without a layer of the shadow mask.
#include "shared/lighting_block.h"

layout(std140, binding = 5) uniform LightingData { LightingBlock lighting; };

// Colour of the sky's light on a horizontal plane, scaled to luminance 1.
const vec3 sky_mean = vec3(0.87, 0.99, 1.28);

// Radiance divided by its mean: blue at the zenith, pale at the horizon. The cosine-weighted mean, which is a fifteenth
// of the way from zenith to horizon, has luminance 1.
vec3 sky_color(float height) {
  const vec3 zenith = vec3(0.42, 0.84, 1.75);
  const vec3 horizon = vec3(2.75, 3.0, 3.2);
  float low = 1.0 - clamp(height, 0.0, 1.0);
  return mix(zenith, horizon, low * low * low * low);
}

// Radiance of an infinite ground plane, lit by direct light and the sky.
vec3 ground_radiance() { return lighting.ground + lighting.ground_albedo * lighting.sky * sky_mean; }

// Radiance from a direction; `blur` softens the horizon.
vec3 surroundings(vec3 direction, float blur) {
  float above = smoothstep(-0.01 - blur, 0.01 + blur, direction.y);
  return mix(ground_radiance(), lighting.sky * sky_color(direction.y), above);
}

// Irradiance over pi on a plane from sky and ground. The scene itself blocks part of the ground's light.
vec3 ambient(vec3 normal) {
  return mix(lighting.ground_light * ground_radiance(), lighting.sky * sky_mean, 0.5 + 0.5 * normal.y);
}
