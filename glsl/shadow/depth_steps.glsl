// The fixed-point form of stored depths in summed-area tables.
#include "shadow/light_projection.glsl"
#include "lib/wide.glsl"

// Steps from stored depth 0 to 1, a power of two: as many as keep every sum of squares over a whole map below 2^64, but
// no more than a float counts exactly.
float depth_steps() { return exp2(min(31.0 - float(findMSB(last_texel().x | 1)), 24.0)); }

// The nearest step to a stored depth.
uint depth_step(float stored) { return uint(round(clamp(stored, 0.0, 1.0) * (depth_steps() - 1.0))); }
