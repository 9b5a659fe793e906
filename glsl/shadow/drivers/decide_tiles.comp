// Decides the tiles that no penumbra reaches. All others are listed: the technique computes their pixels.
#include "shadow/decide_tile.glsl"

layout(binding = 0, rgba32ui) uniform writeonly restrict uimage2D decisions;

void main() {
  ivec2 tile = tile_of_invocation();
  if (!in_viewport(tile)) return;
  Decision decision;
  int outcome = decide_tile(pixels_of(tile), decision);
  imageStore(decisions, tile, outcome == tile_decided ? packed_decision(decision) : no_decision);
  if (outcome == tile_decided) {
    list_decided(tile);
  } else if (outcome == tile_listed) {
    list_tile(tile);
  } else {
    list_rim_tile(tile);
  }
}
