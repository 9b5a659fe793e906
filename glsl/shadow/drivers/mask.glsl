// What a pixel of the mask holds. Included after a technique.
#include "shadow/receive.glsl"
#include "shadow/drivers/gbuffer.glsl"

vec4 shade_pixel(ivec2 pixel) {
  if (is_sky(pixel)) return vec4(1.0, 0.0, 0.0, 0.0);
  return mask_texel(shadow_of(receiver_at(pixel)));
}
