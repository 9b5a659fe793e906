#include "shadow/drivers/mask.glsl"
#include "shadow/drivers/compute_pixels.glsl"
#if LISTED_PIXELS
#include "shadow/drivers/tile_lists.glsl"

uniform int lists_noisy;  // 1: pixels with noise are listed for a filter
#endif

#if PACKED
layout(binding = 0, rg32ui) uniform writeonly restrict uimage2D texels;
layout(binding = 1, r8ui) uniform writeonly restrict uimage2D notes;
#else
layout(binding = 0) uniform writeonly restrict image2DArray mask;  // of any format: see Mask
uniform int mask_layer;
#endif

void main() {
  ivec2 pixel = pixel_in_viewport();
  if (any(greaterThanEqual(pixel, ivec2(shadow.viewport.zw)))) return;
  pixel += ivec2(shadow.viewport.xy);
#if PACKED
  PackedPixel shaded = shade_pixel(pixel);
  imageStore(texels, pixel, uvec4(texel_with_depth(shaded.texel, pixel), 0u, 0u));
  imageStore(notes, pixel, uvec4(shaded.notes));
#elif LISTED_PIXELS
  Receiver receiver = receiver_at(pixel);
  Shadowed shadowed = shadow_of(receiver, light_for(receiver));
  imageStore(mask, ivec3(pixel, mask_layer), mask_texel(shadowed));
  if (lists_noisy != 0 && !shadowed.visibility.noise_free && shadowed.visibility.penumbra_radius > 0.0) {
    uint all = uint(shadow.viewport.z) * uint(shadow.viewport.w);
    list_noisy_pixel(pixel - ivec2(shadow.viewport.xy), packed_pixel(shadowed, receiver, HISTORY_KEPT).texel, all);
  }
#else
  imageStore(mask, ivec3(pixel, mask_layer), shade_pixel(pixel));
#endif
}
