// Sums blocks of the shadow map, or the table itself, along one axis: one work group for each row or column. It takes
// as many elements at once as its invocations hold, and carries their sum on to the next ones (Blelloch 1990, "Prefix
// sums and their applications").
#include "shadow/depth_steps.glsl"

const int invocations = 64, held = 4;  // elements that each invocation sums by itself
layout(local_size_x = invocations) in;
#if ROWS
layout(binding = 0, rgba32ui) uniform writeonly restrict uimage2DArray sums;
#else
layout(binding = 0, rgba32ui) uniform restrict uimage2DArray sums;
#endif

shared uvec4 totals[invocations];
shared uvec4 whole;

// xy: sum of depths; zw: sum of their squares.
uvec4 add(uvec4 a, uvec4 b) { return uvec4(wide_add(a.xy, b.xy), wide_add(a.zw, b.zw)); }

#if ROWS
void add_texel(inout uvec4 sum, float stored) {
  uint depth = depth_step(stored);
  sum = add(sum, uvec4(depth, 0u, wide_product(depth, depth)));
}

// The texels of a block; those beyond the map count as empty.
uvec4 element(ivec3 at) {
  Light light = with_layer(frame_light(), at.z);
  uvec4 sum = uvec4(0u);
  const int side = depth_sums_shrink;
  for (int y = 0; y < side; y += 2) {
    for (int x = 0; x < side; x += 2) {
      vec4 four = gather_stored(vec2(at.xy * side + ivec2(x, y) + 1), light);
      // Of the four, those in the next block are not added.
      bool right = x + 1 < side, up = y + 1 < side;
      add_texel(sum, four.w);
      if (right) add_texel(sum, four.z);
      if (up) add_texel(sum, four.x);
      if (right && up) add_texel(sum, four.y);
    }
  }
  return sum;
}
ivec3 place(int along) { return ivec3(along, gl_WorkGroupID.yz); }
int extent() { return imageSize(sums).x; }
#else
uvec4 element(ivec3 at) { return imageLoad(sums, at); }
ivec3 place(int along) { return ivec3(gl_WorkGroupID.y, along, gl_WorkGroupID.z); }
int extent() { return imageSize(sums).y; }
#endif

// Replaces the totals by the sums of those before each, and writes the sum of all to `whole`.
void scan_totals(int own) {
  for (int step = 1; step < invocations; step *= 2) {
    barrier();
    int at = (own + 1) * 2 * step - 1;
    if (at < invocations) totals[at] = add(totals[at], totals[at - step]);
  }
  barrier();
  if (own == 0) {
    whole = totals[invocations - 1];
    totals[invocations - 1] = uvec4(0u);
  }
  for (int step = invocations / 2; step > 0; step /= 2) {
    barrier();
    int at = (own + 1) * 2 * step - 1;
    if (at < invocations) {
      uvec4 before = totals[at];
      totals[at] = add(before, totals[at - step]);
      totals[at - step] = before;
    }
  }
  barrier();
}

void main() {
  int own = int(gl_LocalInvocationID.x);
  uvec4 carry = uvec4(0u);
  for (int begin = 0; begin < extent(); begin += invocations * held) {
    int first = begin + own * held;
    uvec4 elements[held];
    uvec4 sum = uvec4(0u);
    for (int i = 0; i < held; ++i) {
      if (first + i < extent()) sum = add(sum, element(place(first + i)));
      elements[i] = sum;
    }
    totals[own] = sum;
    scan_totals(own);
    uvec4 before = add(carry, totals[own]);
    for (int i = 0; i < held; ++i) {
      if (first + i < extent()) imageStore(sums, place(first + i), add(before, elements[i]));
    }
    carry = add(carry, whole);
    barrier();
  }
}
