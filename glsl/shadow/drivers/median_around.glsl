// The median of what 3 × 3 pixels hold. Included by filters, which define
//   uint value_of(uint texel)  what is compared, in an order of unsigned integers
#include "shadow/drivers/filter.glsl"
#include "lib/median.glsl"

// The values of two opposite neighbours. A neighbour on another surface says nothing about this pixel's and must not
// affect the median along an edge: it is replaced by the opposite neighbour, or, if both are on other surfaces, by the
// pixel itself, so that there are always nine values.
uvec2 opposite_values(ivec2 pixel, ivec2 offset, uint own, Surface surface) {
  ivec2 low = lowest_pixel();
  ivec2 high = highest_pixel();
  uvec2 values;
  bvec2 counts;
  for (int i = 0; i < 2; ++i) {
    ivec2 to = i == 0 ? offset : -offset;
    ivec2 at = clamp(pixel + to, low, high);
    float depth = stored_depth_at(at);
    values[i] = value_of(texel_at(at));
    counts[i] = at == pixel + to && !is_sky_depth(depth) && abs(plane_distance(surface, to, depth)) <= 1.0;
  }
  return uvec2(counts.x ? values.x : counts.y ? values.y : own, counts.y ? values.y : counts.x ? values.x : own);
}

// For pixels that do not show the sky.
uint median_around(ivec2 pixel) {
  uint own = value_of(texel_at(pixel));
  Surface surface = surface_at(pixel);
  uvec2 a = opposite_values(pixel, ivec2(1, 0), own, surface);
  uvec2 b = opposite_values(pixel, ivec2(0, 1), own, surface);
  uvec2 c = opposite_values(pixel, ivec2(1, 1), own, surface);
  uvec2 d = opposite_values(pixel, ivec2(1, -1), own, surface);
  return median_of_nine(uvec3(a.x, b.x, c.x), uvec3(d.x, own, d.y), uvec3(a.y, b.y, c.y));
}
