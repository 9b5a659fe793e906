// The centre of a tile in one of the lists: a point as large as the tile covers its pixels. Two triangles would run
// the fragment shader twice along their diagonal.
#include "shared/shadow_block.h"
#include "shadow/drivers/tiles.glsl"

#ifndef LISTED_APART
#define LISTED_APART 0  // 1: of the tiles that are listed apart
#endif

layout(std140, binding = 1) uniform ShadowData { ShadowBlock shadow; };

layout(location = 0) flat out ivec2 tile;

void main() {
  // A tile at the viewport's end that is cut off is moved inwards, because points whose centre is outside are clipped.
  // Fragment shaders discard the pixels of other tiles that it then covers.
#if DECIDED
  tile = decided_tile(uint(gl_VertexID));
#elif LISTED_APART
  tile = apart_tile(uint(gl_VertexID));
#else
  tile = listed_tile(uint(gl_VertexID));
#endif
  vec2 low = min(vec2(tile * tile_size), shadow.viewport.zw - float(tile_size));
  gl_Position = vec4((low + 0.5 * float(tile_size)) / shadow.viewport.zw * 2.0 - 1.0, 0.0, 1.0);
}
