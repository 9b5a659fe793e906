// The first four moments of depth, from -1 at the layer's near plane to 1 at its far plane.
#define LOG_SPACE 0
#include "lib/prefilter.glsl"

vec4 of_depth(float depth, int slice) {
  float x = 2.0 * depth - 1.0;
  vec4 moments = vec4(x, x * x, x * x * x, x * x * x * x);
  return msm_format == msm_format_unorm16 ? packed_moments(moments) : moments;
}

#include "shadow/prefilter/from_depth.glsl"
