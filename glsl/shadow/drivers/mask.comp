#include "shadow/drivers/mask.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
#if PACKED
layout(binding = 0, r32ui) uniform writeonly restrict uimage2D texels;
layout(binding = 1, r8ui) uniform writeonly restrict uimage2D notes;
#else
layout(binding = 0, rgba16f) uniform writeonly restrict image2DArray mask;
uniform int mask_layer;
#endif

void main() {
  if (any(greaterThanEqual(ivec2(gl_GlobalInvocationID.xy), ivec2(shadow.viewport.zw)))) return;
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy) + ivec2(shadow.viewport.xy);
#if PACKED
  PackedPixel shaded = shade_pixel(pixel);
  imageStore(texels, pixel, uvec4(shaded.texel));
  imageStore(notes, pixel, uvec4(shaded.notes));
#else
  imageStore(mask, ivec3(pixel, mask_layer), shade_pixel(pixel));
#endif
}
