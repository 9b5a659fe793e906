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
  return with_visibility(texel, mean_on_axis(filter_pass, pixel, surface, sigma, 0.0));
}
