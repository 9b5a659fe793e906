// Lists the tiles whose texels a filter can change. Neither the others nor the tiles around them have a pixel with a
// blocker distance (see Filter::keeps_unblocked).
#include "shared/shadow_block.h"
#include "shadow/drivers/tiles.glsl"
#include "shadow/drivers/tile_lists.glsl"

layout(std140, binding = 1) uniform ShadowData { ShadowBlock shadow; };

const int group = 8;             // tiles along each side that a work group lists
const int around = group + 2;    // those whose texels it reads
layout(local_size_x = group, local_size_y = group) in;
layout(binding = 12) uniform usampler2D texels;
layout(binding = 14) uniform usampler2D decisions;
uniform int has_decisions;

shared bool blocked[around * around];

bool has_blocker(ivec2 tile) {
  if (has_decisions != 0) {
    uvec4 decision = texelFetch(decisions, tile, 0);
    if (is_decided(decision)) return !is_unblocked(decision);
  }
  ivec2 low = tile * tile_size, high = min(low + tile_size, ivec2(shadow.viewport.zw));
  uint distances = 0u;
  ivec2 at = low;
  do {
    distances |= texelFetch(texels, ivec2(shadow.viewport.xy) + at, 0).x & 0xffffu;
    at = at.x + 1 < high.x ? ivec2(at.x + 1, at.y) : ivec2(low.x, at.y + 1);
  } while (distances == 0u && at.y < high.y);
  return distances != 0u;
}

void main() {
  ivec2 last = (ivec2(shadow.viewport.zw) - 1) / tile_size;
  ivec2 first = ivec2(gl_WorkGroupID.xy) * group - 1;
  for (uint i = gl_LocalInvocationIndex; i < blocked.length(); i += group * group) {
    ivec2 tile = first + ivec2(i % around, i / around);
    bool exists = all(greaterThanEqual(tile, ivec2(0))) && all(lessThanEqual(tile, last));
    blocked[i] = exists && has_blocker(tile);
  }
  barrier();
  ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThan(tile, last))) return;
  bool changes = false;
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 3; ++x) {
      changes = changes || blocked[(int(gl_LocalInvocationID.y) + y) * around + int(gl_LocalInvocationID.x) + x];
    }
  }
  if (changes) {
    list_tile(tile);
  } else {
    list_decided(tile);
  }
}
