// Cosine and sine of the depth at two odd frequencies in each slice of the first half, the same times the depth in the
// second.
#define LOG_SPACE 0
#include "lib/fourier.glsl"

vec4 of_depth(float depth, int slice) {
  const int half_of_slices = (cssm_terms + 1) / 2;
  int term = 2 * (slice % half_of_slices);
  vec2 angles = depth * vec2(fourier_frequency(term, cssm_terms), fourier_frequency(term + 1, cssm_terms));
  vec4 waves = vec4(cos(angles.x), sin(angles.x), cos(angles.y), sin(angles.y));
  return slice < half_of_slices ? waves : depth * waves;
}

#include "shadow/prefilter/from_depth.glsl"
