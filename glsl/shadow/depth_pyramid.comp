// Computes one level of the minimum depth pyramid, from 4 × 4 texels of the shadow map or from 2 × 2 texels of the
// finer level.
#include "shared/language.h"

layout(local_size_x = 8, local_size_y = 8) in;
#if FROM_DEPTH
layout(binding = 0) uniform sampler2DArray source;
#else
layout(binding = 0, r32f) uniform readonly restrict image2DArray source;
#endif
layout(binding = 1, r32f) uniform writeonly restrict image2DArray level;

#if FROM_DEPTH
// Texels outside of the map count as empty (depth 1).
float least_depth(ivec3 at) {
  ivec2 size = textureSize(source, 0).xy;
  float least = 1.0;
  for (int y = 0; y < 4; y += 2) {
    for (int x = 0; x < 4; x += 2) {
      ivec2 corner = at.xy * 4 + ivec2(x, y);
      if (any(greaterThanEqual(corner, size))) continue;
      vec4 depths = textureGather(source, vec3((vec2(corner) + 1.0) / vec2(size), float(at.z)));
      least = min(least, min(min(depths.x, depths.y), min(depths.z, depths.w)));
    }
  }
  return least;
}
#else
float least_depth(ivec3 at) {
  ivec3 low = ivec3(at.xy * 2, at.z);
  ivec2 last = imageSize(source).xy - 1;
  float a = imageLoad(source, low).x;
  float b = imageLoad(source, ivec3(min(low.x + 1, last.x), low.yz)).x;
  float c = imageLoad(source, ivec3(low.x, min(low.y + 1, last.y), low.z)).x;
  float d = imageLoad(source, ivec3(min(low.xy + 1, last), low.z)).x;
  return min(min(a, b), min(c, d));
}
#endif

void main() {
  ivec3 at = ivec3(gl_GlobalInvocationID);
  if (any(greaterThanEqual(at.xy, imageSize(level).xy))) return;
  imageStore(level, at, vec4(least_depth(at)));
}
