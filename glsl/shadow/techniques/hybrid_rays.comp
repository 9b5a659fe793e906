// Writes the mask of the pixels that were left to rays.
#include "shadow/techniques/hybrid_mask.glsl"

layout(local_size_x = 64) in;

// Visibility and blocker distance of each, two halves.
layout(std430, binding = 7) restrict readonly buffer Results { uint results[]; };

void main() {
  uint index = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x + gl_GlobalInvocationID.x;
  if (index >= left.count) return;
  ivec2 pixel = ivec2(left.pixels[index].at & 0xffffu, left.pixels[index].at >> 16);
  vec2 result = unpackHalf2x16(results[index]);
  float radius = packed_radius(light_position(view_position_at(pixel)), result.y);
  store(pixel, Visibility(result.x, radius, result.y, false, false), 0);
}
