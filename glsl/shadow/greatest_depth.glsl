// Upper bounds of the depths in a part of the map.
#include "shadow/light_projection.glsl"

// Greatest depths over 4 · 2^level texels squared: the product of that name.
layout(binding = UNIT_greatest_depth_pyramid) uniform sampler2DArray greatest_pyramid;

const float greatest_base = 4.0;

// Upper bound of the depth within a disc, metres.
float greatest_near(vec3 position, float radius, Light light) {
  int level = pyramid_level(position, radius, light, greatest_base, textureQueryLevels(greatest_pyramid));
  ivec2 last = max(last_texel(), 0) >> (level + 2);
  vec4 stored = pyramid_texels(greatest_pyramid, position, radius, light, greatest_base, level, last).x;
  return stored_depth(max(max(stored.x, stored.y), max(stored.z, stored.w)), light);
}
