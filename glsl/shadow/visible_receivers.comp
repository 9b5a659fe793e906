// Finds what the view's depth texture shows of the receivers, for cascades that are fitted to it (Lauritzen, Salvi and
// Lefohn 2010, Sample distribution shadow maps). The first run, with BOUNDS 0, finds the least and the greatest stored
// depth. The second one divides the distances between them into slices, of equal ratios of far to near, and finds for
// each slice how many pixels show it and its bounds in light space.
#include "shared/language.h"

const uint slices = 32u;
// Each invocation reads a row of pixels: they mostly lie in one slice.
const int row = 32;
layout(local_size_x = 4, local_size_y = 16) in;

layout(binding = 2) uniform sampler2D receiver_depth;

// Floats in an order-preserving code: see code_of().
layout(std430, binding = 7) restrict buffer Found {
  uint least, greatest;             // stored depth
  uint unused0, unused1;
  uvec4 low[slices], high[slices];  // metres; w of `high`: how many pixels
} found;

uniform vec4 viewport;  // x, y, width, height; texels
uniform float sky_depth;

// Atomic operations compare unsigned numbers: a greater float has a greater code.
uint code_of(float value) {
  uint bits = floatBitsToUint(value);
  return (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
}

// The pixels that an invocation reads: a part of a line of the viewport.
struct Row {
  ivec2 first;
  int count;
};

Row own_row() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy) * ivec2(row, 1);
  return Row(ivec2(viewport.xy) + at, at.y < int(viewport.w) ? min(int(viewport.z) - at.x, row) : 0);
}

bool is_receiver(float depth) { return depth != sky_depth && !isnan(depth) && !isinf(depth); }

#if BOUNDS

uniform mat4 texel_to_view;  // from x, y in texels and the stored depth
uniform mat4 view_to_light;
uniform float distance_limit;  // metres; 0: none

float value_of(uint code) { return uintBitsToFloat((code & 0x80000000u) != 0u ? code & 0x7fffffffu : ~code); }

vec3 view_position(vec2 at, float depth) {
  vec4 view = texel_to_view * vec4(at, depth, 1.0);
  return view.xyz / view.w;
}

shared uint group_low[3u * slices], group_high[3u * slices], group_count[slices];

// What some pixels show of one slice.
struct Part {
  int slice;
  uint count;
  vec3 low, high;
};

Part empty_part(int slice) { return Part(slice, 0u, vec3(1e30), vec3(-1e30)); }

void add(Part part) {
  if (part.count == 0u) return;
  for (int axis = 0; axis < 3; ++axis) {
    atomicMin(group_low[3 * part.slice + axis], code_of(part.low[axis]));
    atomicMax(group_high[3 * part.slice + axis], code_of(part.high[axis]));
  }
  atomicAdd(group_count[part.slice], part.count);
}

void main() {
  uint own = gl_LocalInvocationIndex;
  if (own < slices) {
    group_count[own] = 0u;
    for (uint axis = 0u; axis < 3u; ++axis) {
      group_low[3u * own + axis] = 0xffffffffu;
      group_high[3u * own + axis] = 0u;
    }
  }
  barrier();

  vec2 middle = viewport.xy + 0.5 * viewport.zw;
  float a = -view_position(middle, value_of(found.least)).z;
  float b = -view_position(middle, value_of(found.greatest)).z;
  float far = max(a, b);
  if (distance_limit > 0.0) far = min(far, distance_limit);
  float near = max(min(a, b), far * 1e-3);
  float slices_a_ratio = float(slices) / max(log2(far / near), 1e-6);

  Row pixels = own_row();
  Part part = empty_part(0);
  for (int i = 0; i < pixels.count; ++i) {
    ivec2 at = pixels.first + ivec2(i, 0);
    float depth = texelFetch(receiver_depth, at, 0).x;
    if (!is_receiver(depth)) continue;
    vec3 position = view_position(vec2(at) + 0.5, depth);
    float away = -position.z;
    if (away > far * 1.0001 || isnan(away)) continue;
    int slice = clamp(int(log2(max(away, near) / near) * slices_a_ratio), 0, int(slices) - 1);
    if (slice != part.slice) {
      add(part);
      part = empty_part(slice);
    }
    vec3 place = mat3(view_to_light) * position;
    part = Part(slice, part.count + 1u, min(part.low, place), max(part.high, place));
  }
  add(part);
  barrier();

  if (own >= slices || group_count[own] == 0u) return;
  for (uint axis = 0u; axis < 3u; ++axis) {
    atomicMin(found.low[own][axis], group_low[3u * own + axis]);
    atomicMax(found.high[own][axis], group_high[3u * own + axis]);
  }
  atomicAdd(found.high[own].w, group_count[own]);
}

#else

shared uint group_least, group_greatest;

void main() {
  if (gl_LocalInvocationIndex == 0u) {
    group_least = 0xffffffffu;
    group_greatest = 0u;
  }
  barrier();

  Row pixels = own_row();
  vec2 range = vec2(1e30, -1e30);
  for (int i = 0; i < pixels.count; ++i) {
    float depth = texelFetch(receiver_depth, pixels.first + ivec2(i, 0), 0).x;
    if (is_receiver(depth)) range = vec2(min(range.x, depth), max(range.y, depth));
  }
  if (range.x <= range.y) {
    atomicMin(group_least, code_of(range.x));
    atomicMax(group_greatest, code_of(range.y));
  }
  barrier();

  if (gl_LocalInvocationIndex != 0u || group_least > group_greatest) return;
  atomicMin(found.least, group_least);
  atomicMax(found.greatest, group_greatest);
}

#endif
