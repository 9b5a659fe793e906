// The depth itself: the logarithm of its exponential.
#define LOG_SPACE 1
#include "shadow/prefilter/esm_factor.glsl"

vec4 of_depth(float depth, int slice) { return vec4(depth); }

#include "shadow/prefilter/from_depth.glsl"
