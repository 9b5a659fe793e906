// Mean along x, then along y (Deligiannis 2019, section 2.7.1). Half its width is σ·√3, so that its variance is that of
// the Gaussian; the pixels at its ends are weighted by the part of them that lies within.
#include "shadow/drivers/filter.glsl"

uint filtered(ivec2 pixel) {
  uint texel = texel_at(pixel);
  float distance_to = kernel_distance(pixel, texel);
  float sigma = distance_to > 0.0 ? kernel_sigma(surface_at(pixel), distance_to)[filter_pass] : 0.0;
  if (sigma < least_sigma) return texel;
  float half_width = 1.7320508 * sigma;
  TapLine taps = taps_along(filter_pass, pixel, half_width + 0.5);
  float sum = 0.0;
  float weights = 0.0;
  int i = taps.first;
  do {
    int offset = tap_offset(taps, i);
    float weight = clamp((half_width - abs(float(offset))) / taps.spacing + 0.5, 0.0, 1.0);
    sum += weight * texel_visibility(texel_at(pixel + along(filter_pass, offset)));
    weights += weight;
  } while (++i <= taps.last);
  return with_visibility(texel, sum / weights);
}
