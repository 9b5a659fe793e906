// Cosine and sine of the depth at two odd frequencies in each slice.
#define LOG_SPACE 0
#include "lib/fourier.glsl"

vec4 of_depth(float depth, int slice) {
  vec2 angles = depth * vec2(fourier_frequency(2 * slice, csm_fourier_terms),
                              fourier_frequency(2 * slice + 1, csm_fourier_terms));
  return vec4(cos(angles.x), sin(angles.x), cos(angles.y), sin(angles.y));
}

#include "shadow/prefilter/from_depth.glsl"
