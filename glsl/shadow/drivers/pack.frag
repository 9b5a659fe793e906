// Converts a mask that a technique's own passes filled to the packed texels and notes that denoisers read.
#include "shadow/drivers/gbuffer.glsl"
#include "shadow/drivers/packed.glsl"

layout(binding = 12) uniform sampler2DArray resolved_mask;
uniform int mask_layer;

layout(location = 0) out uvec2 texel;
layout(location = 1) out uint notes;

PackedPixel pack_pixel(ivec2 pixel) {
  if (is_sky(pixel)) return PackedPixel(pack_texel(0.0, 1.0, true), pack_notes(0, false, false, HISTORY_NONE));
  Receiver receiver = receiver_at(pixel);
  vec4 mask = texelFetch(resolved_mask, ivec3(pixel, mask_layer), 0);
  Visibility seen = Visibility(mask.x, mask.y, mask.z, fract(mask.w) >= 0.5, false);
  uint refusal = HISTORY_NONE;
#if HISTORY
  // How far such a technique reads is not known; its penumbrae are no wider than what casts them.
  Light light = light_at(receiver);
  light.read_radius = seen.penumbra_radius;
  refusal = refusal_of(receiver, light, pixel);
#endif
  return packed_pixel(Shadowed(seen, int(mask.w), false), receiver, refusal);
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  PackedPixel packed_values = pack_pixel(pixel);
  texel = texel_with_depth(packed_values.texel, pixel);
  notes = packed_values.notes;
}
