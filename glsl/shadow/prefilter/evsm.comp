// The first two moments of the depth's exponential warps.
#define LOG_SPACE 0
#include "shadow/prefilter/evsm_warp.glsl"

vec4 of_depth(float depth, int slice) {
  vec2 warped = warped_depth(depth);
  return vec4(warped.x, warped.x * warped.x, warped.y, warped.y * warped.y);
}

#include "shadow/prefilter/from_depth.glsl"
