// What computes the two finest levels of a pyramid over a layer of a map has in common: each invocation reads 8 × 8
// texels with the row around them, and writes their 2 × 2 blocks.
#include "shadow/light_projection.glsl"

// Long rows: a group reads the map's texels in the order in which a linear texture has them in memory.
layout(local_size_x = 32, local_size_y = 2) in;
layout(binding = 0, rg32f) uniform writeonly restrict image2DArray blocks;
layout(binding = 1, rg32f) uniform writeonly restrict image2DArray squares;  // of 2 × 2 blocks

uniform int layer;
uniform ivec4 drawn;  // the lowest and the highest texel that casters were drawn to

// Whether casters were drawn to all texels of a block and of the row around it, as far as the map has them; false for
// blocks beyond the map.
bool is_drawn(ivec2 block) {
  if (any(greaterThan(4 * block, last_texel()))) return false;
  ivec2 first = max(4 * block - 1, ivec2(0)), last = min(4 * block + 4, last_texel());
  return all(greaterThanEqual(first, drawn.xy)) && all(lessThanEqual(last, drawn.zw));
}

float least_of(vec4 v) { return min(min(v.x, v.y), min(v.z, v.w)); }
