#include "shadow/drivers/mask.glsl"
#if TILES
#include "shadow/drivers/tiles.glsl"

layout(location = 0) flat in ivec2 tile;
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
  mask = shade_pixel(ivec2(gl_FragCoord.xy));
}
#endif
