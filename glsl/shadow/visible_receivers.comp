// Finds what the view's depth texture shows of the receivers, for cascades that are fitted to it (Lauritzen, Salvi and
// Lefohn 2011, Sample distribution shadow maps), but for what is shown in decided tiles. The first run, with BOUNDS 0,
// finds the least and the greatest stored depth. The second one divides the distances between them into slices, of
// equal ratios of far to near, and finds for each slice how many pixels show it and its extents along several
// directions across the light.
#include "shared/language.h"
#include "shadow/drivers/decisions.glsl"

const uint slices = 32u;
// Each invocation reads a tile, and adds it to one slice: that of its farthest pixel. Cascades hold what the slices
// before them hold too, so that near slices stay as small as what they show.
layout(local_size_x = 8, local_size_y = 8) in;
const uint invocations = 64u;

layout(binding = 2) uniform sampler2D receiver_depth;
layout(binding = 14) uniform usampler2D decisions;

// Of each slice: the extents along DIRECTIONS directions in light space's x and y, of which the first is the x axis and
// each other one is turned by half a turn / DIRECTIONS more; then the depths along the light.
const uint measures = uint(DIRECTIONS) + 1u;
const uint all_measures = slices * measures;

// Floats in an order-preserving code: see code_of().
layout(std430, binding = 7) restrict buffer Found {
  uint least, greatest;  // stored depth
  uint pixels[slices];
  uint low[all_measures], high[all_measures];  // metres
} found;

uniform vec4 viewport;  // x, y, width, height; texels
uniform float sky_depth;

// Atomic operations compare unsigned numbers: a greater float has a greater code.
uint code_of(float value) {
  uint bits = floatBitsToUint(value);
  return (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
}

// The pixels that an invocation reads, low to high exclusive.
struct Pixels {
  ivec2 low, high;
};

Pixels own_pixels() {
  ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
  ivec2 at = tile_size * tile, end = min(at + tile_size, ivec2(viewport.zw));
  if (all(lessThan(at, end)) && is_decided(texelFetch(decisions, tile, 0))) end = at;
  return Pixels(ivec2(viewport.xy) + at, ivec2(viewport.xy) + end);
}

const float most_finite = 3e38;

// False for sky, and for what is not a number.
bool is_receiver(float depth) { return depth != sky_depth && abs(depth) <= most_finite; }

#if BOUNDS

uniform mat4 texel_to_view;  // from x, y in texels and the stored depth
uniform mat4 view_to_light;
uniform float distance_limit;  // metres; 0: none

float value_of(uint code) { return uintBitsToFloat((code & 0x80000000u) != 0u ? code & 0x7fffffffu : ~code); }

vec3 view_position(vec2 at, float depth) {
  vec4 view = texel_to_view * vec4(at, depth, 1.0);
  return view.xyz / view.w;
}

shared uint group_low[all_measures], group_high[all_measures], group_pixels[slices];

// What a tile shows: extents along four directions, half a right angle apart, and depths along the light.
struct Part {
  uint pixels;
  float farthest;  // metres from where distances are counted
  vec4 low, high;
  vec2 depths;
};

// Along the diagonals as sums, which are longer than distances by a factor of sqrt(2).
vec4 along_four(vec2 place) { return vec4(place.x, place.x + place.y, place.y, place.y - place.x); }
const vec4 per_sum = vec4(1.0, sqrt(0.5), 1.0, sqrt(0.5));

// Most parts change nothing, and looking first is cheaper than an atomic operation.
void add_range(uint index, float low, float high) {
  uint low_code = code_of(low), high_code = code_of(high);
  if (low_code < group_low[index]) atomicMin(group_low[index], low_code);
  if (high_code > group_high[index]) atomicMax(group_high[index], high_code);
}

// The octagon about the part is measured instead of each pixel: it extends beyond them by a little of a tile.
void add(Part part, int slice) {
  const int steps = DIRECTIONS / 4;
  const float right_angle = 1.57079633;
  // The fifth direction is opposite to the first.
  vec4 next_low = vec4(part.low.yzw, -part.high.x), next_high = vec4(part.high.yzw, -part.low.x);
  uint index = uint(slice) * measures, depths = index + uint(DIRECTIONS);
  int i = 0;
  // Each of the four, and the directions between it and the next. The end is no constant, so that drivers do not unroll
  // this loop: atomic operations are long code.
  do {
    for (int step = 0; step < steps; ++step) {
      float angle = 0.5 * right_angle * float(step) / float(steps);
      // A direction between two of the four is this sum of them.
      float of_first = sin(0.5 * right_angle - angle) * sqrt(2.0), of_next = sin(angle) * sqrt(2.0);
      add_range(index + uint(step), of_first * part.low[i] + of_next * next_low[i],
                of_first * part.high[i] + of_next * next_high[i]);
    }
    index += uint(steps);
    ++i;
  } while (index < depths);
  add_range(depths, part.depths.x, part.depths.y);
  atomicAdd(group_pixels[slice], part.pixels);
}

void main() {
  uint own = gl_LocalInvocationIndex;
  for (uint i = own; i < all_measures; i += invocations) {
    group_low[i] = 0xffffffffu;
    group_high[i] = 0u;
  }
  if (own < slices) group_pixels[own] = 0u;
  barrier();

  vec2 middle = viewport.xy + 0.5 * viewport.zw;
  float a = -view_position(middle, value_of(found.least)).z;
  float b = -view_position(middle, value_of(found.greatest)).z;
  // Distances are counted from the camera, or from the nearest receiver if an orthographic view shows it behind that.
  bool orthographic = texel_to_view[2].w == 0.0;
  float start = orthographic ? min(min(a, b), 0.0) : 0.0;
  float far = max(a, b);
  if (distance_limit > 0.0) {
    start = max(start, -distance_limit);
    far = min(far, distance_limit);
  }
  far -= start;
  // Under an oblique near plane the same depth may be behind the camera there, and before it elsewhere.
  if (!(far > 0.0)) far = 1.0;
  float near = max(min(a, b) - start, far * 1e-3);
  float slices_a_ratio = float(slices) / max(log2(far / near), 1e-6);

  // Places in light space and depths in the view are quotients of forms that are linear in the pixel and its depth.
  mat4 to_light = mat4(mat3(view_to_light)) * texel_to_view;
  vec4 to_depth = vec4(texel_to_view[0].z, texel_to_view[1].z, texel_to_view[2].z, texel_to_view[3].z);
  float most_away = distance_limit > 0.0 ? distance_limit * 1.0001 : most_finite;

  Pixels pixels = own_pixels();
  Part part = Part(0u, 0.0, vec4(1e30), vec4(-1e30), vec2(1e30, -1e30));
  for (int y = pixels.low.y; y < pixels.high.y; ++y) {
    vec4 first = vec4(vec2(pixels.low.x, y) + 0.5, 0.0, 1.0);
    vec4 place_at = to_light * first;
    float depth_at = dot(to_depth, first);
    for (int x = pixels.low.x; x < pixels.high.x; ++x) {
      float depth = texelFetch(receiver_depth, ivec2(x, y), 0).x;
      vec4 form = place_at + to_light[2] * depth;
      float per_w = 1.0 / form.w;
      float away = -(depth_at + to_depth.z * depth) * per_w;
      place_at += to_light[0];
      depth_at += to_depth.x;
      if (is_receiver(depth) && abs(away) <= most_away) {
        vec3 place = form.xyz * per_w;
        vec4 across = along_four(place.xy);
        part = Part(part.pixels + 1u, max(part.farthest, away - start), min(part.low, across), max(part.high, across),
                    vec2(min(part.depths.x, place.z), max(part.depths.y, place.z)));
      }
    }
  }
  part.low *= per_sum;
  part.high *= per_sum;
  if (part.pixels > 0u) {
    add(part, clamp(int(log2(max(part.farthest, near) / near) * slices_a_ratio), 0, int(slices) - 1));
  }
  barrier();

  for (uint i = own; i < all_measures; i += invocations) {
    if (group_pixels[i / measures] == 0u) continue;
    atomicMin(found.low[i], group_low[i]);
    atomicMax(found.high[i], group_high[i]);
  }
  if (own < slices && group_pixels[own] > 0u) atomicAdd(found.pixels[own], group_pixels[own]);
}

#else

shared uint group_least, group_greatest;

void main() {
  if (gl_LocalInvocationIndex == 0u) {
    group_least = 0xffffffffu;
    group_greatest = 0u;
  }
  barrier();

  Pixels pixels = own_pixels();
  vec2 range = vec2(1e30, -1e30);
  for (int y = pixels.low.y; y < pixels.high.y; ++y) {
    for (int x = pixels.low.x; x < pixels.high.x; ++x) {
      float depth = texelFetch(receiver_depth, ivec2(x, y), 0).x;
      if (is_receiver(depth)) range = vec2(min(range.x, depth), max(range.y, depth));
    }
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
