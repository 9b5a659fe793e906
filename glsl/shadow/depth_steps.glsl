// The fixed-point form of stored depths in summed-area tables.
#include "shadow/light_projection.glsl"
#include "lib/wide.glsl"

// Steps from stored depth 0 to 1, a power of two: as many as keep every sum of squares over all blocks of a map below
// 2^64, but no more than a float counts exactly. The last block can reach beyond the map.
float depth_steps() {
  int last = (last_texel().x / depth_sums_shrink + 1) * depth_sums_shrink - 1;
  return exp2(min(31.0 - float(findMSB(last | 1)), 24.0));
}

// The nearest step to a stored depth.
uint depth_step(float stored) { return uint(round(clamp(stored, 0.0, 1.0) * (depth_steps() - 1.0))); }
