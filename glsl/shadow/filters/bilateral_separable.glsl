// The bilateral filter along x, then along y, each with the pixel's own σ (Pham and van Vliet 2005). This only
// approximates the full filter, since the second pass does not know which of the pixels averaged into a neighbour lay
// across an edge from this pixel.
#include "shadow/drivers/filter.glsl"

uint filtered(ivec2 pixel) {
  uint texel = texel_at(pixel);
  float distance_to = kernel_distance(pixel, texel);
  Surface surface = surface_at(pixel);
  float sigma = distance_to > 0.0 ? kernel_sigma(surface, distance_to)[filter_pass] : 0.0;
  if (sigma < least_sigma) return texel;
  TapLine taps = taps_along(filter_pass, pixel, 2.0 * sigma);
  float falloff = -0.5 / (sigma * sigma);
  float sum = 0.0;
  float weights = 0.0;
  for (int i = taps.first; i <= taps.last; ++i) {
    int offset = tap_offset(taps, i);
    ivec2 to = along(filter_pass, offset);
    float depth = stored_depth_at(pixel + to);
    float off_plane = plane_distance(surface, to, depth);
    float weight = exp(falloff * float(offset * offset) - 0.5 * off_plane * off_plane);
    weight = is_sky_depth(depth) ? 0.0 : weight;
    sum += weight * texel_visibility(texel_at(pixel + to));
    weights += weight;
  }
  return with_visibility(texel, sum / weights);
}
