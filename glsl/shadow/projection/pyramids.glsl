// Pyramids over the light's layer of the map, whose level 0 has one texel for `base` texels of the map along each axis.
#include "shadow/projection/map.glsl"
#include "lib/rows.glsl"

// The finest level of so many at which a rectangle of these half widths touches at most 2 × 2 texels.
int pyramid_level(vec3 position, vec2 radius, Light light, float base, int levels) {
  vec2 square = radius * outline_reach(light) / light.map.texel_shares;
  return covering_level(max(square.x, square.y), base * texel_size_at(position, light), levels);
}

int pyramid_level(vec3 position, float radius, Light light, float base, int levels) {
  return pyramid_level(position, vec2(radius), light, base, levels);
}

struct TexelRange {
  ivec2 low, high;
};

// The texel after one of a range, row by row; above the range after the last one.
ivec2 next_texel(ivec2 at, TexelRange range) { return next_in_rows(at, range.low.x, range.high.x, 1); }

// The texels of a level that a rectangle of these half widths touches; `last` is the level's last texel.
TexelRange pyramid_range(vec3 position, vec2 radius, Light light, float base, int level, ivec2 last) {
  vec2 texel = base * texel_extent_at(position, light) * float(1 << level);
  radius *= outline_reach(light);
  vec2 origin = position.xy - light.map.center + 0.5 / light.map.widths_per_metre;
  return TexelRange(clamp(ivec2(floor((origin - radius) / texel)), ivec2(0), last),
                    clamp(ivec2(floor((origin + radius) / texel)), ivec2(0), last));
}

// The two channels of 2 × 2 texels, at a level where a disc touches no more.
struct PyramidTexels {
  vec4 x, y;
};

PyramidTexels pyramid_texels(sampler2DArray pyramid, vec3 position, float radius, Light light, float base, int level,
                             ivec2 last) {
  TexelRange range = pyramid_range(position, vec2(radius), light, base, level, last);
  vec2 a = texelFetch(pyramid, ivec3(range.low, light.layer), level).xy;
  vec2 b = texelFetch(pyramid, ivec3(range.high.x, range.low.y, light.layer), level).xy;
  vec2 c = texelFetch(pyramid, ivec3(range.low.x, range.high.y, light.layer), level).xy;
  vec2 d = texelFetch(pyramid, ivec3(range.high, light.layer), level).xy;
  return PyramidTexels(vec4(a.x, b.x, c.x, d.x), vec4(a.y, b.y, c.y, d.y));
}
