// Decides the tiles of every n-th pixel, by those of all pixels.
#include "shadow/drivers/tiles.glsl"
#include "shadow/drivers/tile_lists.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, rgba32ui) uniform writeonly restrict uimage2D decisions;
layout(binding = 14) uniform usampler2D decisions_of_all;

uniform ivec2 size, size_of_all;  // pixels
uniform int scale;
uniform int has_faces;  // the light has several: all tiles are listed apart

// Adds the pixels that a tile of all pixels decides, `at` that many tiles from the first one. Returns whether all are
// lit.
bool add_bits(ivec2 tile, ivec2 at, uvec2 from, inout uvec2 lit) {
  ivec2 first = (tile_size * at + scale - 1) / scale, last = (tile_size * (at + 1) - 1) / scale;
  last = min(last, size - 1 - tile_size * tile);
  bool all_lit = true;
  for (int y = first.y; y <= last.y; ++y) {
    for (int x = first.x; x <= last.x; ++x) {
      ivec2 place = scale * ivec2(x, y) - tile_size * at;
      int bit = tile_size * place.y + place.x, to = tile_size * y + x;
      uint is_lit = (from[bit >> 5] >> (bit & 31)) & 1u;
      lit[to >> 5] |= is_lit << (to & 31);
      all_lit = all_lit && is_lit != 0u;
    }
  }
  return all_lit;
}

void main() {
  ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(tile * tile_size, size))) return;
  Decision decision = Decision(uvec2(0u), 0.0, 0.0, 0);
  float blocked = 0.0;
  bool decided = true, apart = has_faces != 0, has_layer = false, faces_away = false;
  for (int i = 0; i < scale * scale; ++i) {
    ivec2 at = ivec2(i % scale, i / scale);
    if (any(greaterThanEqual((scale * tile + at) * tile_size, size_of_all))) continue;
    uvec4 texel = texelFetch(decisions_of_all, scale * tile + at, 0);
    if (!is_decided(texel)) {
      decided = false;
      apart = apart || is_listed_apart(texel);
      continue;
    }
    Decision part = unpacked_decision(texel);
    bool all_lit = add_bits(tile, at, part.lit, decision.lit);
    decision.radius = max(decision.radius, part.radius);
    // The finest layer, but for tiles that may show nothing but sky, which have layer 0.
    if (part.radius > 0.0 || part.layer > 0) {
      decision.layer = has_layer ? min(decision.layer, part.layer) : part.layer;
      has_layer = true;
    }
    decision.blocker_distance += part.blocker_distance;
    blocked += float(part.blocker_distance > 0.0);
    faces_away = faces_away || (part.blocker_distance == 0.0 && !all_lit);
  }
  // A decision has one distance for all of its pixels that are not lit.
  decided = decided && !(faces_away && blocked > 0.0);
  decision.blocker_distance /= max(blocked, 1.0);
  imageStore(decisions, tile, decided ? packed_decision(decision) : no_decision(apart));
  if (decided) {
    list_decided(tile);
  } else if (apart) {
    list_tile_apart(tile);
  } else {
    list_tile(tile);
  }
}
