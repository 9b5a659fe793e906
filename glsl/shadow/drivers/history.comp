#include "shadow/drivers/history.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, rg32ui) uniform writeonly restrict uimage2D kept_texels;
layout(binding = 1, rg32ui) uniform writeonly restrict uimage2D kept_surfaces;

void main() {
  if (any(greaterThanEqual(ivec2(gl_GlobalInvocationID.xy), ivec2(shadow.viewport.zw)))) return;
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy) + ivec2(shadow.viewport.xy);
  Kept kept = blend(pixel);
  imageStore(kept_texels, pixel, uvec4(texel_with_depth(kept.texel, pixel), 0u, 0u));
  imageStore(kept_surfaces, pixel, uvec4(kept.surface, 0u, 0u));
}
