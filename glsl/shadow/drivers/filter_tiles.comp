// Lists the tiles whose texels a filter can change. The others are decided, and neither they nor the tiles around them
// have a pixel with a blocker distance (see Filter::keeps_unblocked).
#include "shared/shadow_block.h"
#include "shadow/drivers/tiles.glsl"
#include "shadow/drivers/tile_lists.glsl"

layout(std140, binding = 1) uniform ShadowData { ShadowBlock shadow; };

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 14) uniform usampler2D decisions;

void main() {
  ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
  ivec2 last = (ivec2(shadow.viewport.zw) - 1) / tile_size;
  if (any(greaterThan(tile, last))) return;
  bool unblocked = true;
  for (int y = max(tile.y - 1, 0); y <= min(tile.y + 1, last.y); ++y) {
    for (int x = max(tile.x - 1, 0); x <= min(tile.x + 1, last.x); ++x)
      unblocked = unblocked && is_unblocked(texelFetch(decisions, ivec2(x, y), 0));
  }
  if (unblocked) {
    list_decided(tile);
  } else {
    list_tile(tile);
  }
}
