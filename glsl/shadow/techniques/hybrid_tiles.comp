// Writes the mask of tiles that the map decides as a whole, and lists the others.
#define LEAVES_TO_RAYS 1
#include "shadow/decide_tile.glsl"
#include "shadow/techniques/hybrid_mask.glsl"

void store_tile(Pixels pixels, Decision decision) {
  Light light = with_layer(frame_light(), decision.layer);
  ivec2 at = pixels.low;
  do {
    int bit = bit_of(pixels, at);
    bool is_lit = ((decision.lit[bit >> 5] >> (bit & 31)) & 1u) != 0u;
    store_decided(at, is_lit, decision.blocker_distance, light);
    at = next_pixel(at, pixels);
  } while (at.y < pixels.high.y);
}

void main() {
  ivec2 tile = tile_of_invocation();
  if (!in_viewport(tile)) return;
  Pixels pixels = pixels_of(tile);
  Decision decision;
  float overlap;
  if (decide_tile(pixels, decision, overlap) == tile_decided) {
    store_tile(pixels, decision);
  } else {
    list_tile(tile);
  }
}
