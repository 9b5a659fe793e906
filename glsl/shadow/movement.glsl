// Looks up in the pyramid of the movement map, of either form, whether casters moved.
#include "shadow/light.glsl"

layout(binding = 10) uniform sampler2DArray shadow_movement;

// Whether anything moved within `radius` metres of a position in the light's layer of the map (and a little beyond:
// 2 × 2 texels of the finest level that covers the disc, and the texels that the disc touches).
bool movement_seen(vec3 position, float radius, Light light) {
  int level = pyramid_level(position, radius, light, 1.0, textureQueryLevels(shadow_movement));
  ivec2 last = max(textureSize(shadow_movement, 0).xy >> level, ivec2(1)) - 1;
  vec4 moved = pyramid_texels(shadow_movement, position, radius, light, 1.0, level, last).x;
  return max(max(moved.x, moved.y), max(moved.z, moved.w)) > 0.0;
}
