// Decides the tiles that no penumbra reaches. All others are listed: the technique computes their pixels.
#include "shadow/decide_tile.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, rgba32ui) uniform writeonly restrict uimage2D decisions;

void main() {
  ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
  if (!in_viewport(tile)) return;
  Decision decision;
  if (decide_tile(pixels_of(tile), decision)) {
    imageStore(decisions, tile, packed_decision(decision));
    list_decided(tile);
  } else {
    imageStore(decisions, tile, no_decision);
    list_tile(tile);
  }
}
