// Where casters with an alpha mask lie, which can be too narrow for the shadow map to show: least stored depths over
// 4 · 2^level texels squared.
layout(binding = 9) uniform sampler2DArray masked_casters;
uniform int has_masked_casters;

// The least depth, metres, of such casters over a rectangle of these half widths and a little beyond.
float masked_depth(vec3 position, vec2 radius, Light light) {
  int level = pyramid_level(position, 0.25 * radius, light, pyramid_base, textureQueryLevels(masked_casters));
  ivec2 last = max(last_texel(), 0) >> (level + 2);
  TexelRange range = pyramid_range(position, radius, light, pyramid_base, level, last);
  float stored = 1.0;
  ivec2 at = range.low;
  do {
    stored = min(stored, texelFetch(masked_casters, ivec3(at, light.layer), level).x);
    at = next_texel(at, range);
  } while (at.y <= range.high.y);
  return stored_depth(stored, light);
}

// As edges_are_clear(), for such casters instead of edges.
bool masks_are_clear(Receiver deepest, float radius, vec2 half_widths, Light light) {
  if (has_masked_casters == 0) return true;
  float margin = (2.0 + bias_normal_offset) * texel_size(deepest, light);
  for (int i = 0; i < 3; ++i) {
    float nearest = masked_depth(deepest.position, half_widths + radius + margin, light);
    if (nearest >= deepest.position.z) return true;
    float needed = penumbra_radius(deepest, deepest.position.z - nearest, light);
    if (needed >= radius) return false;
    radius = needed;
  }
  return false;
}
