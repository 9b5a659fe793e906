// Leaves the pixels of the listed tiles to rays. The map decides no single pixels: that would take about as long as the
// rays that it saves.
#include "shadow/drivers/tiles.glsl"
#include "shadow/techniques/hybrid_mask.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 8) uniform usampler2D surface_ids;

// Whether a surface faces away from all parts of the light.
bool faces_away_from_all(Receiver receiver, Light light) {
  return light_cosine(receiver) <= -1.5 / cone_slope(receiver, light);
}

void main() {
  uint index = gl_WorkGroupID.y * list_row + gl_WorkGroupID.x;
  if (index >= tile_list.listed.count) return;
  ivec2 at = listed_tile(index) * tile_size + ivec2(gl_LocalInvocationID.xy);
  if (any(greaterThanEqual(at, ivec2(shadow.viewport.zw)))) return;
  ivec2 pixel = at + ivec2(shadow.viewport.xy);
  Light light = frame_light();
  bool sky = is_sky(pixel);
  if (sky || faces_away_from_all(receiver_at(pixel), light)) {
    store_decided(pixel, sky, 0.0, light);
  } else {
    uvec2 shown = texelFetch(surface_ids, pixel, 0).xy;
    left.pixels[atomicAdd(left.count, 1u)] = LeftPixel(uint(pixel.x) | uint(pixel.y) << 16, shown.x, shown.y);
  }
}
