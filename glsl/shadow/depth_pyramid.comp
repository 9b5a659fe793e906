// One level of the minimum and maximum depth pyramid: from the map's 4 × 4 texels, or from the level below's 2 × 2.
#include "shared/language.h"

layout(local_size_x = 8, local_size_y = 8) in;
#if FROM_DEPTH
layout(binding = 0) uniform sampler2DArray source;
#else
layout(binding = 0, rg32f) uniform readonly restrict image2DArray source;
#endif
layout(binding = 1, rg32f) uniform writeonly restrict image2DArray level;

#if FROM_DEPTH
// Beyond the map's edge there is nothing.
vec2 bounds(ivec3 at) {
  ivec2 size = textureSize(source, 0).xy;
  float least = 1.0, greatest = 0.0;
  for (int y = 0; y < 4; y += 2) {
    for (int x = 0; x < 4; x += 2) {
      ivec2 corner = at.xy * 4 + ivec2(x, y);
      if (any(greaterThanEqual(corner, size))) continue;
      vec4 depths = textureGather(source, vec3((vec2(corner) + 1.0) / vec2(size), float(at.z)));
      least = min(least, min(min(depths.x, depths.y), min(depths.z, depths.w)));
      greatest = max(greatest, max(max(depths.x, depths.y), max(depths.z, depths.w)));
    }
  }
  return vec2(least, greatest);
}
#else
vec2 bounds(ivec3 at) {
  ivec3 low = ivec3(at.xy * 2, at.z);
  ivec2 last = imageSize(source).xy - 1;
  vec2 a = imageLoad(source, low).xy;
  vec2 b = imageLoad(source, ivec3(min(low.x + 1, last.x), low.yz)).xy;
  vec2 c = imageLoad(source, ivec3(low.x, min(low.y + 1, last.y), low.z)).xy;
  vec2 d = imageLoad(source, ivec3(min(low.xy + 1, last), low.z)).xy;
  return vec2(min(min(a.x, b.x), min(c.x, d.x)), max(max(a.y, b.y), max(c.y, d.y)));
}
#endif

void main() {
  ivec3 at = ivec3(gl_GlobalInvocationID);
  if (any(greaterThanEqual(at.xy, imageSize(level).xy))) return;
  imageStore(level, at, vec4(bounds(at), 0.0, 0.0));
}
