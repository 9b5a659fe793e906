#include "shadow/drivers/mask.glsl"
#if TILES || MISSING
#include "shadow/drivers/tiles.glsl"
#endif
#if TILES
layout(location = 0) flat in ivec2 tile;
#endif
#if MISSING
layout(binding = 14) uniform usampler2D missing_pixels;

bool is_missing(ivec2 pixel) {
  ivec2 place = pixel - ivec2(shadow.viewport.xy);
  int bit = tile_size * (place.y % tile_size) + place.x % tile_size;
  return ((texelFetch(missing_pixels, place / tile_size, 0)[bit >> 5] >> (bit & 31)) & 1u) != 0u;
}
#endif

#if PACKED
layout(location = 0) out uvec2 texel;
layout(location = 1) out uint notes;

void main() {
#if TILES
  if ((ivec2(gl_FragCoord.xy) - ivec2(shadow.viewport.xy)) / tile_size != tile) discard;
#endif
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  PackedPixel shaded = shade_pixel(pixel);
  texel = texel_with_depth(shaded.texel, pixel);
  notes = shaded.notes;
}
#else
layout(location = 0) out vec4 mask;

void main() {
#if TILES
  if ((ivec2(gl_FragCoord.xy) - ivec2(shadow.viewport.xy)) / tile_size != tile) discard;
#endif
#if MISSING
  if (!is_missing(ivec2(gl_FragCoord.xy))) discard;
#endif
  mask = shade_pixel(ivec2(gl_FragCoord.xy));
}
#endif
