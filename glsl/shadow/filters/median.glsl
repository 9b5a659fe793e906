// Median of the mean blocker distances of 3 × 3 pixels, before the size of a kernel is taken from them (Deligiannis
// 2019, section 3.4). With few taps, the blocker search misses blockers that cover little of the disc, so single pixels
// of a penumbra have no distance. Such pixels take part with distance 0. But if most of the nine found no blocker and
// the pixel itself did, it keeps its own distance: it is darkened, and without a kernel it would remain a dark dot.
// Non-negative half floats are compared by their bits, which are in the same order.
#include "shadow/drivers/filter.glsl"
#include "lib/median.glsl"

// The distances of two opposite neighbours. A neighbour on another surface says nothing about this pixel's penumbra and
// must not affect the median along an edge: it is replaced by the opposite neighbour, or, if both are on other
// surfaces, by the pixel itself, so that there are always nine values.
uvec2 opposite_distances(ivec2 pixel, ivec2 offset, uint own, Surface surface) {
  ivec2 low = lowest_pixel();
  ivec2 high = highest_pixel();
  uvec2 distances;
  bvec2 counts;
  for (int i = 0; i < 2; ++i) {
    ivec2 to = i == 0 ? offset : -offset;
    ivec2 at = clamp(pixel + to, low, high);
    float depth = stored_depth_at(at);
    distances[i] = texel_at(at) & 0xffffu;
    counts[i] = at == pixel + to && !is_sky_depth(depth) && abs(plane_distance(surface, to, depth)) <= 1.0;
  }
  return uvec2(counts.x ? distances.x : counts.y ? distances.y : own,
               counts.y ? distances.y : counts.x ? distances.x : own);
}

uint filtered(ivec2 pixel) {
  uint texel = texel_at(pixel);
  if (is_sky_depth(stored_depth_at(pixel))) return texel;
  uint own = texel & 0xffffu;
  Surface surface = surface_at(pixel);
  uvec2 a = opposite_distances(pixel, ivec2(1, 0), own, surface);
  uvec2 b = opposite_distances(pixel, ivec2(0, 1), own, surface);
  uvec2 c = opposite_distances(pixel, ivec2(1, 1), own, surface);
  uvec2 d = opposite_distances(pixel, ivec2(1, -1), own, surface);
  uint median = median_of_nine(uvec3(a.x, b.x, c.x), uvec3(d.x, own, d.y), uvec3(a.y, b.y, c.y));
  return (texel & 0xffff0000u) | (median == 0u ? own : median);
}
