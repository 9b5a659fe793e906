#include "shadow/drivers/mask.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
#if PACKED
layout(binding = 0, r32ui) uniform writeonly restrict uimage2D texels;
layout(binding = 1, r8ui) uniform writeonly restrict uimage2D notes;
#else
layout(binding = 0) uniform writeonly restrict image2DArray mask;  // of any format: see Mask
uniform int mask_layer;
#endif

#if TILES
#include "shadow/drivers/tiles.glsl"

// The pixel of an invocation in a group that runs over a listed tile; beyond the viewport where there is no such tile.
ivec2 pixel_in_viewport() {
  uint index = gl_WorkGroupID.y * list_row + gl_WorkGroupID.x;
#if RIM_LIST
  if (index >= tile_list.rim.count) return ivec2(shadow.viewport.zw);
  ivec2 tile = rim_tile(index);
#else
  if (index >= tile_list.listed.count) return ivec2(shadow.viewport.zw);
  ivec2 tile = listed_tile(index);
#endif
  return tile * tile_size + ivec2(gl_LocalInvocationID.xy);
}
#else
ivec2 pixel_in_viewport() { return ivec2(gl_GlobalInvocationID.xy); }
#endif

void main() {
  ivec2 pixel = pixel_in_viewport();
  if (any(greaterThanEqual(pixel, ivec2(shadow.viewport.zw)))) return;
  pixel += ivec2(shadow.viewport.xy);
#if PACKED
  PackedPixel shaded = shade_pixel(pixel);
  imageStore(texels, pixel, uvec4(shaded.texel));
  imageStore(notes, pixel, uvec4(shaded.notes));
#else
  imageStore(mask, ivec3(pixel, mask_layer), shade_pixel(pixel));
#endif
}
