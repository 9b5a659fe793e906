// Computes two levels of a movement map's pyramid from the next finer one. Each invocation computes one texel of the
// second level and the texels of the first that it covers.
layout(local_size_x = 8, local_size_y = 8) in;
#if AVERAGE
layout(binding = 0, r16) uniform readonly image2DArray source;
layout(binding = 1, r16) uniform writeonly image2DArray first;
layout(binding = 2, r16) uniform writeonly image2DArray second;
#else
layout(binding = 0, r8) uniform readonly image2DArray source;
layout(binding = 1, r8) uniform writeonly image2DArray first;
layout(binding = 2, r8) uniform writeonly image2DArray second;
#endif

uniform int size;         // of level 0
uniform int below;        // level of the source
uniform vec4 regions[8];  // by layer: lowest and highest texel of level 0 between which something can have moved

int size_of(int level) { return max(size >> level, 1); }

// The texel of a level that covers a texel of level 0.
ivec2 texel_at(ivec2 base, int level) { return min(base >> level, size_of(level) - 1); }

#if ANY_SIZE
// If the size is not a power of two, the last texels of a level also cover the remainder: up to 3 × 3 texels of the
// finer level, and so more of level 0 than others.
struct Range {
  ivec2 low, high;
};

Range children(ivec2 at, int level) {
  int last = size_of(level) - 1;
  int end = size_of(level + 1) - 1;
  return Range(min(at * 2, ivec2(last)), ivec2(at.x == end ? last : at.x * 2 + 1, at.y == end ? last : at.y * 2 + 1));
}

// Number of level-0 texels that a texel covers.
float area(ivec2 at, int level) {
  int end = size_of(level) - 1;
  ivec2 rest = size - (at << level);
  return float(at.x == end ? rest.x : 1 << level) * float(at.y == end ? rest.y : 1 << level);
}

struct Sum {
  float value, area, most;
};

void add(inout Sum sum, float value, float area) {
  sum.value += value * area;
  sum.area += area;
  sum.most = max(sum.most, value);
}

float result(Sum sum) {
#if AVERAGE
  return sum.value / sum.area;
#else
  return sum.most;
#endif
}

float first_texel(ivec3 at) {
  Range range = children(at.xy, below);
  Sum sum = Sum(0.0, 0.0, 0.0);
  for (int y = range.low.y; y <= range.high.y; ++y) {
    for (int x = range.low.x; x <= range.high.x; ++x) {
      add(sum, imageLoad(source, ivec3(x, y, at.z)).x, area(ivec2(x, y), below));
    }
  }
  return result(sum);
}

float second_texel(ivec3 at) {
  Range range = children(at.xy, below + 1);
  Sum sum = Sum(0.0, 0.0, 0.0);
  for (int y = range.low.y; y <= range.high.y; ++y) {
    for (int x = range.low.x; x <= range.high.x; ++x) {
      float value = first_texel(ivec3(x, y, at.z));
      imageStore(first, ivec3(x, y, at.z), vec4(value));
      add(sum, value, area(ivec2(x, y), below + 1));
    }
  }
  return result(sum);
}
#else
float reduced(vec4 values) {
#if AVERAGE
  return dot(values, vec4(0.25));
#else
  return max(max(values.x, values.y), max(values.z, values.w));
#endif
}

float first_texel(ivec3 at) {
  ivec3 low = ivec3(at.xy * 2, at.z);
  return reduced(vec4(imageLoad(source, low).x, imageLoad(source, low + ivec3(1, 0, 0)).x,
                      imageLoad(source, low + ivec3(0, 1, 0)).x, imageLoad(source, low + ivec3(1, 1, 0)).x));
}

float second_texel(ivec3 at) {
  vec4 values;
  for (int i = 0; i < 4; ++i) {
    ivec3 child = ivec3(at.xy * 2, at.z) + ivec3(i & 1, i >> 1, 0);
    values[i] = first_texel(child);
    imageStore(first, child, vec4(values[i]));
  }
  return reduced(values);
}
#endif

void main() {
  vec4 region = regions[gl_GlobalInvocationID.z];
  ivec2 low = texel_at(ivec2(region.xy), below + 2);
  ivec2 high = texel_at(ivec2(region.zw), below + 2);
  ivec3 at = ivec3(low, 0) + ivec3(gl_GlobalInvocationID);
  if (region.z < region.x || any(greaterThan(at.xy, high))) return;
  float value = second_texel(at);
  if (size >> (below + 2) != 0) imageStore(second, at, vec4(value));  // else the first level is the last one
}
