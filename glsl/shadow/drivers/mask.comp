#include "shadow/drivers/mask.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, rgba16f) uniform writeonly restrict image2DArray mask;
uniform int mask_layer;

void main() {
  if (any(greaterThanEqual(ivec2(gl_GlobalInvocationID.xy), ivec2(shadow.viewport.zw)))) return;
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy) + ivec2(shadow.viewport.xy);
  imageStore(mask, ivec3(pixel, mask_layer), shade_pixel(pixel));
}
