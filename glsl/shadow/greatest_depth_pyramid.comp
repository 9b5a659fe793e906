// Computes one level of the pyramid of greatest depths, from 4 × 4 texels of the shadow map or from 2 × 2 texels of the
// finer level.
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 1, r32f) uniform writeonly restrict image2DArray level;

float greatest_of(vec4 v) { return max(max(v.x, v.y), max(v.z, v.w)); }

#if FROM_DEPTH
#include "shadow/light_projection.glsl"

// Texels outside of the map count as empty (depth 1).
float greatest_depth(ivec3 at) {
  Light light = with_layer(frame_light(), at.z);
  float greatest = 0.0;
  for (int i = 0; i < 4; ++i) {
    vec2 place = vec2(at.xy * 4 + 1 + 2 * ivec2(i & 1, i >> 1));
    greatest = max(greatest, greatest_of(gather_stored(place, light)));
  }
  return greatest;
}
#else
layout(binding = 0, r32f) uniform readonly restrict image2DArray source;

float greatest_depth(ivec3 at) {
  ivec3 low = ivec3(at.xy * 2, at.z);
  return greatest_of(vec4(imageLoad(source, low).x, imageLoad(source, low + ivec3(1, 0, 0)).x,
                          imageLoad(source, low + ivec3(0, 1, 0)).x, imageLoad(source, low + ivec3(1, 1, 0)).x));
}
#endif

void main() {
  ivec3 at = ivec3(gl_GlobalInvocationID);
  if (all(lessThan(at.xy, imageSize(level).xy))) imageStore(level, at, vec4(greatest_depth(at)));
}
