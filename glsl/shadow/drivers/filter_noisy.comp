// Filters the listed pixels of a mask that have noise: a mean along the longer axis of their kernel. Most are listed
// because their penumbrae are narrow along the other one. Neighbours read the mask, so results go to the list first;
// with STORES 1 they are copied to the mask.
#include "shadow/drivers/filter.glsl"
#include "shadow/drivers/tiles.glsl"

layout(local_size_x = pixel_group) in;

layout(binding = 12) uniform sampler2DArray source_mask;
layout(binding = 0) uniform writeonly image2DArray mask;  // of any format: see Mask
uniform int mask_layer;

uint own_texel;

// A mask has no blocker distances: neighbours take the pixel's own.
uint texel_at(ivec2 pixel) {
  return with_visibility(own_texel, texelFetch(source_mask, ivec3(pixel, mask_layer), 0).x);
}
float stored_depth_at(ivec2 pixel) { return texelFetch(receiver_depth, pixel, 0).x; }

uint filtered(ivec2 pixel) {
  Surface surface = surface_at(pixel);
  vec2 sigma = kernel_sigma(surface, texel_distance(own_texel));
  int axis = sigma.x >= sigma.y ? 0 : 1;
  // Where both are alike, the axis may lie across the penumbra.
  float width = max(sigma[axis] - sigma[1 - axis], 0.5 * sigma[axis]);
  if (width < least_sigma) return own_texel;
  return with_visibility(own_texel, mean_on_axis(axis, pixel, surface, width, 0.0));
}

void main() {
  uint index = (gl_WorkGroupID.y * list_row + gl_WorkGroupID.x) * pixel_group + gl_LocalInvocationIndex;
  if (index >= tile_list.noisy_count) return;
  uint at = noisy_pixel_at(index, uint(shadow.viewport.z) * uint(shadow.viewport.w));
  ivec2 pixel = unpacked_tile(tile_list.tiles[at]) + lowest_pixel();
  own_texel = tile_list.tiles[at + 1u];
#if STORES
  vec4 texel = texelFetch(source_mask, ivec3(pixel, mask_layer), 0);
  texel.x = texel_visibility(own_texel);
  imageStore(mask, ivec3(pixel, mask_layer), texel);
#else
  tile_list.tiles[at + 1u] = filtered(pixel);
#endif
}
