// Bilateral filter (2.42 of Deligiannis 2019) over the whole kernel: a Gaussian times exp(−½ (d/e)²), with d a
// neighbour's distance from the receiver's plane and e the width of filter.edge pixels at the receiver. Not the
// distance from the receiver itself, which would reject a floor seen at a grazing angle. Sky pixels have weight 0.
#include "shadow/drivers/filter.glsl"

uint filtered(ivec2 pixel) {
  uint texel = texel_at(pixel);
  float distance_to = kernel_distance(pixel, texel);
  Surface surface = surface_at(pixel);
  vec2 sigma = distance_to > 0.0 ? kernel_sigma(surface, distance_to) : vec2(0.0);
  if (max(sigma.x, sigma.y) < least_sigma) return texel;
  sigma = max(sigma, least_sigma);
  TapLine columns = taps_along(0, pixel, 2.0 * sigma.x);
  TapLine rows = taps_along(1, pixel, 2.0 * sigma.y);
  vec2 falloff = -0.5 / (sigma * sigma);
  float sum = 0.0;
  float weights = 0.0;
  int j = rows.first;
  do {
    int i = columns.first;
    do {
      ivec2 to = ivec2(tap_offset(columns, i), tap_offset(rows, j));
      float depth = stored_depth_at(pixel + to);
      float off_plane = plane_distance(surface, to, depth);
      float weight = exp(dot(falloff, vec2(to * to)) - 0.5 * off_plane * off_plane);
      weight = is_sky_depth(depth) ? 0.0 : weight;
      sum += weight * texel_visibility(texel_at(pixel + to));
      weights += weight;
    } while (++i <= columns.last);
  } while (++j <= rows.last);
  return with_visibility(texel, sum / weights);
}
