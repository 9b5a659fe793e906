// A filter pass of the compute driver that reads textures. Included after the filter.
#include "shadow/drivers/filter.glsl"
#include "shadow/drivers/filter_output.glsl"
#include "shadow/drivers/compute_pixels.glsl"

layout(binding = 12) uniform usampler2D source_texels;
#if TO_MASK
layout(binding = 0) uniform writeonly restrict image2DArray mask;  // of any format: see Mask
uniform int mask_layer;
#else
layout(binding = 0, rg32ui) uniform writeonly restrict uimage2D texels;
#endif

uint texel_at(ivec2 pixel) { return texelFetch(source_texels, pixel, 0).x; }
float stored_depth_at(ivec2 pixel) { return uintBitsToFloat(texelFetch(source_texels, pixel, 0).y); }

void main() {
  ivec2 pixel = pixel_in_viewport() + lowest_pixel();
  if (any(greaterThan(pixel, highest_pixel()))) return;
#if TO_MASK
  imageStore(mask, ivec3(pixel, mask_layer), unpacked(filtered(pixel), pixel));
#else
  imageStore(texels, pixel, uvec4(filtered_with_depth(pixel), 0u, 0u));
#endif
}
