// A filter pass whose work groups load what they read into shared memory. Included after the filter.
#include "shadow/drivers/filter.glsl"
#include "shadow/drivers/filter_output.glsl"

layout(local_size_x = GROUP_X, local_size_y = GROUP_Y) in;

layout(binding = 12) uniform usampler2D source_texels;
#if TO_MASK
layout(binding = 0) uniform writeonly restrict image2DArray mask;  // of any format: see Mask
uniform int mask_layer;
#else
layout(binding = 0, rg32ui) uniform writeonly restrict uimage2D texels;
#endif

// The group's pixels, with a border as wide as Filter::border.
const ivec2 border = ivec2(BORDER_X, BORDER_Y);
const ivec2 tile_size = ivec2(GROUP_X, GROUP_Y) + 2 * border;
shared uint tile_texels[tile_size.x * tile_size.y];
shared float tile_depths[tile_size.x * tile_size.y];

ivec2 tile_corner() {
  return ivec2(gl_WorkGroupID.xy) * ivec2(GROUP_X, GROUP_Y) + ivec2(shadow.viewport.xy) - border;
}

int tile_index(ivec2 pixel) {
  ivec2 at = pixel - tile_corner();
  return at.y * tile_size.x + at.x;
}

uint texel_at(ivec2 pixel) { return tile_texels[tile_index(pixel)]; }
float stored_depth_at(ivec2 pixel) { return tile_depths[tile_index(pixel)]; }

// Pixels outside of the viewport are never read, neither here nor by the filter.
void load_tile() {
  for (int i = int(gl_LocalInvocationIndex); i < tile_size.x * tile_size.y; i += GROUP_X * GROUP_Y) {
    ivec2 pixel = tile_corner() + ivec2(i % tile_size.x, i / tile_size.x);
    if (any(lessThan(pixel, lowest_pixel())) || any(greaterThan(pixel, highest_pixel()))) continue;
    uvec2 source = texelFetch(source_texels, pixel, 0).xy;
    tile_texels[i] = source.x;
    tile_depths[i] = uintBitsToFloat(source.y);
  }
  barrier();
}

void main() {
  load_tile();
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy) + lowest_pixel();
  if (any(greaterThan(pixel, highest_pixel()))) return;
#if TO_MASK
  imageStore(mask, ivec3(pixel, mask_layer), unpacked(filtered(pixel), pixel));
#else
  imageStore(texels, pixel, uvec4(filtered_with_depth(pixel), 0u, 0u));
#endif
}
