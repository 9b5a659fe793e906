// A pass of a filter. Included after the filter.
#include "shadow/drivers/filter.glsl"
#include "shadow/drivers/filter_output.glsl"

layout(binding = 12) uniform usampler2D source_texels;

#if TILES
#include "shadow/drivers/tiles.glsl"

layout(location = 0) flat in ivec2 tile;

bool is_of_tile(ivec2 pixel) { return (pixel - lowest_pixel()) / tile_size == tile; }
#else
bool is_of_tile(ivec2 pixel) { return true; }
#endif

uint texel_at(ivec2 pixel) { return texelFetch(source_texels, pixel, 0).x; }
float stored_depth_at(ivec2 pixel) { return uintBitsToFloat(texelFetch(source_texels, pixel, 0).y); }

#if TO_MASK
layout(location = 0) out vec4 mask;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  if (!is_of_tile(pixel)) discard;
  mask = unpacked(filtered(pixel), pixel);
}
#else
layout(location = 0) out uvec2 texel;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  if (!is_of_tile(pixel)) discard;
  texel = filtered_with_depth(pixel);
}
#endif
