// Writes the mask of tiles that the map decides as a whole, and lists the others.
#define LEAVES_TO_RAYS 1
#include "shadow/decide_tile.glsl"
#include "shadow/techniques/hybrid_mask.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

void store_tile(Pixels pixels, Decision decision) {
  Light light = with_layer(frame_light(), decision.layer);
  for (int y = pixels.low.y; y < pixels.high.y; ++y) {
    for (int x = pixels.low.x; x < pixels.high.x; ++x) {
      int bit = tile_size * (y - pixels.low.y) + x - pixels.low.x;
      bool is_lit = ((decision.lit[bit >> 5] >> (bit & 31)) & 1u) != 0u;
      store_decided(ivec2(x, y), is_lit, decision.blocker_distance, light);
    }
  }
}

void main() {
  ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
  if (!in_viewport(tile)) return;
  Pixels pixels = pixels_of(tile);
  Decision decision;
  if (decide_tile(pixels, decision) == tile_decided) {
    store_tile(pixels, decision);
  } else {
    list_tile(tile);
  }
}
