// The sky, and the ground around the scene: lighting without a layer of the shadow mask.
#include "shared/lighting_block.h"
#include "lib/sky_map.glsl"

layout(std140, binding = 5) uniform LightingData { LightingBlock lighting; };

// What a surface mirrors: radiance from a direction; `blur` softens the horizon.
vec3 mirrored_light(AmbientLight ambient, vec3 direction, float blur) {
  float low = low_sky(direction.y);
  float side = 1.0 + low * ambient.side * dot(direction.xz, ambient.sun_side);
  vec3 sky = max(side * ambient.zenith + low * ambient.horizon, vec3(0.0));
  return mix(ambient.ground, sky, smoothstep(-0.01 - blur, 0.01 + blur, direction.y));
}

// Irradiance over pi on a plane from sky and ground.
vec3 irradiance(AmbientLight ambient, vec3 normal) {
  float u = dot(normal.xz, ambient.sun_side), y = normal.y;
  float shares = 1.0 + y * y * ambient.shares.x + u * (ambient.shares.y + y * ambient.shares.z + u * ambient.shares.w);
  return max(shares * ambient.vertical + y * ambient.upward, vec3(0.0));
}
