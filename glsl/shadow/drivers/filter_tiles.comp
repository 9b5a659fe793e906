// Lists the tiles whose texels a filter can change. The others have no pixel within `reach` of one with a blocker
// distance: a filter of distances spreads them by one pixel, and visibility filters look two pixels far for one (see
// Filter::keeps_unblocked).
#include "shared/shadow_block.h"
#include "lib/rows.glsl"
#include "shadow/drivers/tiles.glsl"
#include "shadow/drivers/tile_lists.glsl"

layout(std140, binding = 1) uniform ShadowData { ShadowBlock shadow; };

const int group = 8;             // tiles along each side that a work group lists
const int around = group + 2;    // those whose texels it reads
layout(local_size_x = group, local_size_y = group) in;
layout(binding = 12) uniform usampler2D texels;
layout(binding = 14) uniform usampler2D decisions;
uniform int has_decisions;

// Bits as in Decision::lit: pixels that have a blocker distance, of decided tiles also those that face away or lie
// beyond the viewport.
shared uvec2 blocked[around * around];

uvec2 blocked_pixels(ivec2 tile) {
  if (has_decisions != 0) {
    uvec4 decision = texelFetch(decisions, tile, 0);
    if (is_decided(decision)) return is_unblocked(decision) ? uvec2(0u) : ~decision.xy;
  }
  ivec2 low = tile * tile_size, size = min(ivec2(shadow.viewport.zw) - low, tile_size);
  uvec2 found = uvec2(0u);
  ivec2 at = ivec2(0);
  do {
    bool is_blocked = (texelFetch(texels, ivec2(shadow.viewport.xy) + low + at, 0).x & 0xffffu) != 0u;
    int bit = tile_size * at.y + at.x;
    found[bit >> 5] |= uint(is_blocked) << (bit & 31);
    at = next_in_rows(at, 0, size.x - 1, 1);
  } while (at.y < size.y);
  return found;
}

// The pixels of a tile on that side, -1, 0 or 1 along each axis, that are within reach of the tile in the middle.
uvec2 pixels_in_reach(ivec2 side) {
  const uint reach = 3u;
  const uint low = (1u << reach) - 1u, high = low << (uint(tile_size) - reach);
  uint row = 0x01010101u * (side.x == 0 ? 0xffu : side.x < 0 ? high : low);
  const uint low_rows = (1u << (reach * uint(tile_size))) - 1u, high_rows = ~0u << (32u - reach * uint(tile_size));
  return uvec2(row) & (side.y == 0 ? uvec2(~0u) : side.y < 0 ? uvec2(0u, high_rows) : uvec2(low_rows, 0u));
}

void main() {
  ivec2 last = (ivec2(shadow.viewport.zw) - 1) / tile_size;
  ivec2 first = ivec2(gl_WorkGroupID.xy) * group - 1;
  for (uint i = gl_LocalInvocationIndex; i < blocked.length(); i += group * group) {
    ivec2 tile = first + ivec2(i % around, i / around);
    bool exists = all(greaterThanEqual(tile, ivec2(0))) && all(lessThanEqual(tile, last));
    blocked[i] = exists ? blocked_pixels(tile) : uvec2(0u);
  }
  barrier();
  ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThan(tile, last))) return;
  uvec2 near = uvec2(0u);
  for (int y = -1; y <= 1; ++y) {
    for (int x = -1; x <= 1; ++x) {
      ivec2 place = ivec2(gl_LocalInvocationID.xy) + 1 + ivec2(x, y);
      near |= blocked[place.y * around + place.x] & pixels_in_reach(ivec2(x, y));
    }
  }
  if (near != uvec2(0u)) {
    list_tile(tile);
  } else {
    list_decided(tile);
  }
}
