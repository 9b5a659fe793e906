// Median of the mean blocker distances of 3 × 3 pixels, before the size of a kernel is taken from them (Deligiannis
// 2019, section 3.4). With few taps, the blocker search misses blockers that cover little of the disc, so single pixels
// of a penumbra have no distance. Such pixels take part with distance 0. But if most of the nine found no blocker and
// the pixel itself did, it keeps its own distance: it is darkened, and without a kernel it would remain a dark dot.
// Non-negative half floats are compared by their bits, which are in the same order.
// Pixels without noise keep theirs, and count as such that found none.
#include "shadow/drivers/filter.glsl"

uint value_of(uint texel) { return is_noise_free(texel) ? 0u : texel & distance_bits; }
#include "shadow/drivers/median_around.glsl"

uint filtered(ivec2 pixel) {
  uint texel = texel_at(pixel);
  if (is_sky_depth(stored_depth_at(pixel)) || is_noise_free(texel)) return texel;
  uint own = value_of(texel), median = median_around(pixel);
  return (texel & ~distance_bits) | (median == 0u ? own : median);
}
