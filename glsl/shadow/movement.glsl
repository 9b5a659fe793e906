// Whether casters moved: the pyramid over the movement map, of either form.
#include "shadow/light.glsl"

layout(binding = 10) uniform sampler2DArray shadow_movement;

// Whether anything moved within `radius` metres of a position in the cascade's map (and a little beyond: 2 × 2 texels
// of the finest level that covers the disc, and the texels that the disc touches).
bool movement_seen(vec3 position, float radius, int cascade_index) {
  CascadeBlock cascade = shadow.cascades[cascade_index];
  int level = covering_level(radius, cascade.map.w, textureQueryLevels(shadow_movement));
  float texel = cascade.map.w * exp2(float(level));
  ivec2 last = max(textureSize(shadow_movement, 0).xy >> level, ivec2(1)) - 1;
  vec2 origin = position.xy - cascade.map.xy + 0.5 / cascade.map.z;
  ivec2 low = clamp(ivec2(floor((origin - radius) / texel)), ivec2(0), last);
  ivec2 high = clamp(ivec2(floor((origin + radius) / texel)), ivec2(0), last);
  float a = texelFetch(shadow_movement, ivec3(low, cascade_index), level).x;
  float b = texelFetch(shadow_movement, ivec3(high.x, low.y, cascade_index), level).x;
  float c = texelFetch(shadow_movement, ivec3(low.x, high.y, cascade_index), level).x;
  float d = texelFetch(shadow_movement, ivec3(high, cascade_index), level).x;
  return max(max(a, b), max(c, d)) > 0.0;
}
