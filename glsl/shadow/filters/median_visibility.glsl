// Median of the visibility of 3 × 3 pixels (Deligiannis 2019, section 2.7.1). It removes pixels that differ from most
// of those around them, and so also shadows that are narrower than two pixels.
uint value_of(uint texel) { return (texel >> 16) & 0x7fffu; }
#include "shadow/drivers/median_around.glsl"

uint filtered(ivec2 pixel) {
  uint texel = texel_at(pixel);
  if (is_sky_depth(stored_depth_at(pixel)) || is_noise_free(texel)) return texel;
  return (texel & 0x8000ffffu) | (median_around(pixel) << 16);
}
