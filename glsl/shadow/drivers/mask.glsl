// Computes a pixel of the mask. Included after a technique.
#include "shadow/receive.glsl"
#include "shadow/drivers/gbuffer.glsl"
#include "shadow/drivers/packed.glsl"
#if PACKED

PackedPixel shade_pixel(ivec2 pixel) {
  if (is_sky(pixel)) return PackedPixel(pack_texel(0.0, 1.0, true), pack_notes(0, false, false, HISTORY_NONE));
  Receiver receiver = receiver_at(pixel);
  Light light = light_for(receiver);
  uint refusal = HISTORY_NONE;
#if HISTORY
  refusal = refusal_of(receiver, light, pixel);
  receiver.history_refused = refusal != HISTORY_KEPT;
#endif
  return packed_pixel(shadow_of(receiver, light), receiver, refusal);
}
#else

vec4 shade_pixel(ivec2 pixel) {
  if (is_sky(pixel)) return vec4(1.0, 0.0, 0.0, 0.0);
  Receiver receiver = receiver_at(pixel);
  return mask_texel(shadow_of(receiver, light_for(receiver)));
}
#endif
