#include "lib/prefilter.glsl"

vec2 warp_exponents() {
  int bits = evsm_format == evsm_format_float16 ? 16 : 32;
  return min(vec2(evsm_positive, evsm_negative), largest_exponent(bits));
}

vec2 warped_depth(float stored) { return exponential_warp(2.0 * stored - 1.0, warp_exponents()); }
