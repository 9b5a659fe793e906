// Gaussian of 2.40 (Deligiannis 2019) along x, then along y: exp(−x²/2σ²), cut off at 2σ.
#include "shadow/drivers/filter.glsl"

uint filtered(ivec2 pixel) {
  uint texel = texel_at(pixel);
  float distance_to = kernel_distance(pixel, texel);
  float sigma = distance_to > 0.0 ? kernel_sigma(surface_at(pixel), distance_to)[filter_pass] : 0.0;
  if (sigma < least_sigma) return texel;
  TapLine taps = taps_along(filter_pass, pixel, 2.0 * sigma);
  float falloff = -0.5 / (sigma * sigma);
  float sum = 0.0;
  float weights = 0.0;
  int i = taps.first;
  do {
    int offset = tap_offset(taps, i);
    float weight = exp(falloff * float(offset * offset));
    sum += weight * texel_visibility(texel_at(pixel + along(filter_pass, offset)));
    weights += weight;
  } while (++i <= taps.last);
  return with_visibility(texel, sum / weights);
}
