// Decides the tiles that no penumbra reaches. All others are listed: the technique computes their pixels.
#include "shadow/decide_tile.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, rgba32ui) uniform writeonly restrict uimage2D decisions;

void list_decided(ivec2 tile) {
  uint index = atomicAdd(tile_list.decided.count, 1u);
  tile_list.tiles[tile_list.capacity - 1u - index] = packed_tile(tile);
}

void main() {
  ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
  if (!in_viewport(tile)) return;
  Decision decision;
  if (decide_tile(pixels_of(tile), decision)) {
    imageStore(decisions, tile, packed_decision(decision));
    list_decided(tile);
  } else {
    list_undecided(tile);
  }
}
