// Writes the mask of those pixels of the listed tiles that the map decides; the others are left to rays.
#define LEAVES_TO_RAYS 1
#include "shadow/decide_tile.glsl"
#include "shadow/techniques/hybrid_mask.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 8) uniform usampler2D surface_ids;

PixelState state_of(ivec2 pixel, inout Light light) {
  if (is_sky(pixel)) return PixelState(lit, 0.0);
  Receiver receiver = receiver_at(pixel);
  int facing = facing_of(receiver, light);
  if (facing != lit) return PixelState(facing, 0.0);
  float radius = search_radius(receiver, light);
  LayerChoice choice = choose_layer(receiver, radius, light);
  light = with_layer(light, choice.layer);
  if (choice.outside || !edges_are_clear(receiver, radius, vec2(0.0), light)) return PixelState(undecided, 0.0);
  return decide_receiver(receiver, light);
}

void main() {
  uint index = gl_WorkGroupID.y * list_row + gl_WorkGroupID.x;
  if (index >= tile_list.listed.count) return;
  ivec2 at = listed_tile(index) * tile_size + ivec2(gl_LocalInvocationID.xy);
  if (any(greaterThanEqual(at, ivec2(shadow.viewport.zw)))) return;
  ivec2 pixel = at + ivec2(shadow.viewport.xy);
  Light light = frame_light();
  PixelState state = state_of(pixel, light);
  if (state.kind == undecided) {
    uvec2 shown = texelFetch(surface_ids, pixel, 0).xy;
    left.pixels[atomicAdd(left.count, 1u)] = LeftPixel(uint(pixel.x) | uint(pixel.y) << 16, shown.x, shown.y);
  } else {
    store_decided(pixel, state.kind == lit, state.blocker_distance, light);
  }
}
