// The first two moments of depth, counted from the middle of the layer's range: more digits are left for the variance.
#define LOG_SPACE 0

vec4 of_depth(float depth, int slice) {
  float centred = depth - 0.5;
  return vec4(centred, centred * centred, 0.0, 0.0);
}

#include "shadow/prefilter/from_depth.glsl"
