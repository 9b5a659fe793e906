// Mean and variance of the map's depth over rectangles, from the product depth_sums.
#include "shadow/depth_steps.glsl"

layout(binding = UNIT_depth_sums) uniform usampler2DArray depth_sums;

struct Moments {
  float mean;         // of depth less the position's, metres
  float mean_square;  // of the same, metres²
};

float variance_of(Moments moments) { return max(moments.mean_square - moments.mean * moments.mean, 0.0); }

// Sums over all blocks before a corner.
uvec4 sums_before(ivec2 corner, Light light) {
  if (min(corner.x, corner.y) <= 0) return uvec4(0u);
  return texelFetch(depth_sums, ivec3(corner - 1, light.layer), 0);
}

uvec4 sums_less(uvec4 a, uvec4 b) { return uvec4(wide_subtract(a.xy, b.xy), wide_subtract(a.zw, b.zw)); }

// Moments over a rectangle around a position, as far as it lies in the map. Blocks that it covers in part count in
// part. All sums are exact up to the conversion to floats, which takes place after the position's own depth is
// subtracted: so variance keeps its precision wherever in the map's range the depths are.
Moments depth_moments(vec3 position, vec2 half_width, Light light) {
  const float side = float(depth_sums_shrink);
  ivec2 blocks = textureSize(depth_sums, 0).xy;
  vec2 low = clamp(map_place(vec3(position.xy - half_width, position.z), light) / side, vec2(0.0), vec2(blocks));
  vec2 high = clamp(map_place(vec3(position.xy + half_width, position.z), light) / side, vec2(0.0), vec2(blocks));
  ivec2 first = min(ivec2(low), blocks - 1), last = min(ivec2(high), blocks - 1);
  // Three bands along each axis: the first block, those between and the last one.
  vec2 begin_share = mix(vec2(first + 1) - low, high - low, equal(first, last));
  vec2 end_share = mix(high - vec2(last), vec2(0.0), equal(first, last));
  vec2 shares[3] = vec2[](begin_share, vec2(1.0), end_share);
  ivec2 lines[4] = ivec2[](first, first + 1, max(last, first + 1), max(last, first) + 1);
  uint own = depth_step(stored_of(position.z, light));
  uvec2 square = wide_product(own, own);
  float count = 0.0, sum = 0.0, square_sum = 0.0;
  uvec4 below[4];
  for (int x = 0; x < 4; ++x) below[x] = sums_before(ivec2(lines[x].x, lines[0].y), light);
  for (int y = 0; y < 3; ++y) {
    uvec4 left = uvec4(0u);
    for (int x = 0; x < 4; ++x) {
      uvec4 corner = sums_before(ivec2(lines[x].x, lines[y + 1].y), light);
      uvec4 column = sums_less(corner, below[x]);  // all blocks of the band before the corner
      below[x] = corner;
      if (x > 0) {
        uvec4 inside = sums_less(column, left);
        ivec2 size = ivec2(lines[x].x - lines[x - 1].x, lines[y + 1].y - lines[y].y) * depth_sums_shrink;
        uint texels = uint(size.x * size.y);
        float share = shares[x - 1].x * shares[y].y;
        count += share * float(texels);
        sum += share * wide_signed(wide_subtract(inside.xy, wide_product(own, texels)));
        uvec2 twice = wide_times(inside.xy, 2u * own);
        square_sum += share * wide_unsigned(wide_subtract(wide_add(inside.zw, wide_times(square, texels)), twice));
      }
      left = column;
    }
  }
  float step_metres = stored_metres(light) / (depth_steps() - 1.0);
  float weight = 1.0 / max(count, 1e-6);
  return Moments(step_metres * weight * sum, step_metres * step_metres * weight * square_sum);
}
