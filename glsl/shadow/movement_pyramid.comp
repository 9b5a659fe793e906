// Two levels of a movement map's pyramid from the one below them: a texel of the second and its texels of the first are
// one invocation. The last texels of a level have what a size that is no power of two leaves over.
#include "shared/language.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform sampler2DArray map;
#if AVERAGE
layout(binding = 1, r16) uniform writeonly image2DArray first;
layout(binding = 2, r16) uniform writeonly image2DArray second;
#else
layout(binding = 1, r8) uniform writeonly image2DArray first;
layout(binding = 2, r8) uniform writeonly image2DArray second;
#endif

uniform int below;         // level that is read
uniform vec4 regions[8];   // by layer: lowest and highest texel of level 0 between which something can have moved

// A range of texels of a level.
struct Range {
  ivec2 low, high;
};

ivec2 size_of(int level) { return max(textureSize(map, 0).xy >> level, ivec2(1)); }

// Texel of a level that has a texel of level 0.
ivec2 texel_at(ivec2 base, int level) { return min(base >> level, size_of(level) - 1); }

// Those that a texel of the next level has.
Range children(ivec2 at, int level) {
  ivec2 last = size_of(level) - 1;
  bvec2 at_end = equal(at, size_of(level + 1) - 1);
  return Range(min(at * 2, last), ivec2(at_end.x ? last.x : at.x * 2 + 1, at_end.y ? last.y : at.y * 2 + 1));
}

#if AVERAGE
// Texels of level 0 that a texel has.
float area(ivec2 at, int level) {
  ivec2 rest = textureSize(map, 0).xy - (at << level);
  bvec2 at_end = equal(at, size_of(level) - 1);
  return float(at_end.x ? rest.x : 1 << level) * float(at_end.y ? rest.y : 1 << level);
}
#endif

float reduced(ivec3 at) {
  Range range = children(at.xy, below);
  float sum = 0.0;
  float weight = 0.0;
  for (int y = range.low.y; y <= range.high.y; ++y) {
    for (int x = range.low.x; x <= range.high.x; ++x) {
      float value = texelFetch(map, ivec3(x, y, at.z), below).x;
#if AVERAGE
      float share = area(ivec2(x, y), below);
      sum += share * value;
      weight += share;
#else
      sum = max(sum, value);
      weight = 1.0;
#endif
    }
  }
  return sum / weight;
}

void main() {
  vec4 region = regions[gl_GlobalInvocationID.z];
  ivec2 low = texel_at(ivec2(region.xy), below + 2);
  ivec2 high = texel_at(ivec2(region.zw), below + 2);
  ivec3 at = ivec3(low, 0) + ivec3(gl_GlobalInvocationID);
  if (region.z < region.x || any(greaterThan(at.xy, high))) return;
  Range range = children(at.xy, below + 1);
  float sum = 0.0;
  float weight = 0.0;
  for (int y = range.low.y; y <= range.high.y; ++y) {
    for (int x = range.low.x; x <= range.high.x; ++x) {
      float value = reduced(ivec3(x, y, at.z));
      imageStore(first, ivec3(x, y, at.z), vec4(value));
#if AVERAGE
      float share = area(ivec2(x, y), below + 1);
      sum += share * value;
      weight += share;
#else
      sum = max(sum, value);
      weight = 1.0;
#endif
    }
  }
  imageStore(second, at, vec4(sum / weight));
}
