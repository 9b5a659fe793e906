// Decides the tiles that no penumbra reaches. All others are listed: the technique computes their pixels.
#include "shadow/decide_tile.glsl"

uniform float wide_overlap;  // pixels

layout(binding = 0, rgba32ui) uniform writeonly restrict uimage2D decisions;

void main() {
  ivec2 tile = tile_of_invocation();
  if (!in_viewport(tile)) return;
  Decision decision;
  float overlap;
  int outcome = decide_tile(pixels_of(tile), decision, overlap);
  if (overlap > 0.0 && overlap >= wide_overlap) atomicAdd(tile_list.wide_overlaps, 1u);
  imageStore(decisions, tile, outcome == tile_decided ? packed_decision(decision) : no_decision(outcome == tile_apart));
  if (outcome == tile_decided) {
    list_decided(tile);
  } else if (outcome == tile_listed) {
    list_tile(tile);
  } else {
    list_tile_apart(tile);
  }
}
