#include "shadow/techniques/ssss_soften.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform writeonly restrict image2DArray mask;  // of any format: see Mask
uniform int mask_layer;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, ivec2(shadow.viewport.zw)))) return;
  pixel += ivec2(shadow.viewport.xy);
  imageStore(mask, ivec3(pixel, mask_layer), soft_pixel(pixel));
}
