// Decides the tiles of every n-th pixel, by those of all pixels: a tile is decided if all that it lies in are.
#include "shadow/drivers/tiles.glsl"
#include "shadow/drivers/tile_lists.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, rgba32ui) uniform writeonly restrict uimage2D decisions;
layout(binding = 14) uniform usampler2D decisions_of_all;

uniform ivec2 tile_count, tile_count_of_all;
uniform int scale;

// Copies the bits of a tile of all pixels, `at` that many tiles from the first one, which are those of every n-th.
void copy_bits(ivec2 at, uvec2 from, inout uvec2 lit) {
  ivec2 first = (tile_size * at + scale - 1) / scale, last = (tile_size * (at + 1) - 1) / scale;
  for (int y = first.y; y <= last.y; ++y) {
    for (int x = first.x; x <= last.x; ++x) {
      ivec2 place = scale * ivec2(x, y) - tile_size * at;
      int bit = tile_size * place.y + place.x, to = tile_size * y + x;
      lit[to >> 5] |= ((from[bit >> 5] >> (bit & 31)) & 1u) << (to & 31);
    }
  }
}

void main() {
  ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(tile, tile_count))) return;
  Decision decision = Decision(uvec2(0u), 0.0, 0.0, 0);
  float blocked = 0.0;
  bool decided = true, at_rim = false, has_layer = false, faces_away = false;
  for (int i = 0; i < scale * scale; ++i) {
    ivec2 at = ivec2(i % scale, i / scale);
    if (any(greaterThanEqual(scale * tile + at, tile_count_of_all))) continue;
    uvec4 texel = texelFetch(decisions_of_all, scale * tile + at, 0);
    decided = decided && is_decided(texel);
    at_rim = at_rim || is_at_rim(texel);
    if (!decided) continue;
    Decision part = unpacked_decision(texel);
    copy_bits(at, part.lit, decision.lit);
    decision.radius = max(decision.radius, part.radius);
    // Tiles that show only sky are in no layer.
    if (part.radius > 0.0) decision.layer = has_layer ? min(decision.layer, part.layer) : part.layer;
    has_layer = has_layer || part.radius > 0.0;
    decision.blocker_distance += part.blocker_distance;
    blocked += float(part.blocker_distance > 0.0);
    faces_away = faces_away || (part.blocker_distance == 0.0 && part.lit != uvec2(~0u));
  }
  // A decision has one distance for all of its pixels that are not lit.
  decided = decided && !(faces_away && blocked > 0.0);
  decision.blocker_distance /= max(blocked, 1.0);
  imageStore(decisions, tile, decided ? packed_decision(decision) : at_rim ? no_decision_at_rim : no_decision);
  if (decided) {
    list_decided(tile);
  } else if (at_rim) {
    list_rim_tile(tile);
  } else {
    list_tile(tile);
  }
}
