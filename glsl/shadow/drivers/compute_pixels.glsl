// The pixels of the compute driver's work groups: of all pixels, with TILES 1 of the listed tiles, or with
// LISTED_PIXELS 1 those of a list.
layout(local_size_x = 8, local_size_y = 8) in;

#ifndef LISTED_APART
#define LISTED_APART 0  // 1: the tiles that are listed apart
#endif

#ifndef LISTED_PIXELS
#define LISTED_PIXELS 0
#endif

#if TILES || LISTED_PIXELS
#include "shadow/drivers/tiles.glsl"

// An invocation's pixel; beyond the viewport where the group has no tile.
ivec2 pixel_in_viewport() {
  uint index = gl_WorkGroupID.y * list_row + gl_WorkGroupID.x;
#if LISTED_PIXELS
  index = index * gl_WorkGroupSize.x * gl_WorkGroupSize.y + gl_LocalInvocationIndex;
  return index < tile_list.pixel_count ? listed_pixel(index) : ivec2(shadow.viewport.zw);
#else
#if LISTED_APART
  if (index >= tile_list.apart.count) return ivec2(shadow.viewport.zw);
  ivec2 tile = apart_tile(index);
#else
  if (index >= tile_list.listed.count) return ivec2(shadow.viewport.zw);
  ivec2 tile = listed_tile(index);
#endif
  return tile * tile_size + ivec2(gl_LocalInvocationID.xy);
#endif
}
#else
ivec2 pixel_in_viewport() { return ivec2(gl_GlobalInvocationID.xy); }
#endif
