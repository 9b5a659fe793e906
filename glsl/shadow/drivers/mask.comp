#include "shadow/drivers/mask.glsl"
#include "shadow/drivers/compute_pixels.glsl"

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
#else
  imageStore(mask, ivec3(pixel, mask_layer), shade_pixel(pixel));
#endif
}
