#ifndef PENUMBRA_SUM_OF_GROUP_GLSL
#define PENUMBRA_SUM_OF_GROUP_GLSL

// A work group adds up its lanes' values, in an order that never changes.

const int group_size = 256;

layout(local_size_x = group_size) in;

shared vec2 lanes[group_size];

// Every lane gets the sum. All of them have to call it, once.
vec2 sum_of_group(vec2 value) {
  uint lane = gl_LocalInvocationIndex;
  lanes[lane] = value;
  barrier();
  for (uint step = uint(group_size) / 2u; step > 0u; step >>= 1) {
    if (lane < step) lanes[lane] += lanes[lane + step];
    barrier();
  }
  return lanes[0];
}

#endif
