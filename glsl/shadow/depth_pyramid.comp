// Computes one level of the depth pyramid, from 4 × 4 texels of the shadow map or from 2 × 2 texels of the finer level.
#include "shared/language.h"

// Long rows: a group reads the map's texels in the order in which a linear texture has them in memory.
layout(local_size_x = 32, local_size_y = 2) in;
layout(binding = 1, rg32f) uniform writeonly restrict image2DArray level;

uniform vec4 drawn[8];    // by layer, the lowest and the highest texel that casters were drawn to
uniform int level_shift;  // a texel of the level covers 2^level_shift texels of the map along each axis

#if FROM_DEPTH
#include "shadow/light_projection.glsl"

// The lesser depth of each of four pairs of neighbours that make an edge, 1 for others.
vec4 depths_at_edges(vec4 a, vec4 b, float height) {
  return mix(vec4(1.0), min(a, b), greaterThan(abs(a - b), vec4(height)));
}

float least_of(vec4 v) { return min(min(v.x, v.y), min(v.z, v.w)); }

// Whether casters were drawn to all texels of a block and of the row around it, as far as the map has them.
bool is_drawn(ivec3 at) {
  ivec2 first = max(4 * at.xy - 1, ivec2(0)), last = min(4 * at.xy + 4, last_texel());
  return all(greaterThanEqual(first, ivec2(drawn[at.z].xy))) && all(lessThanEqual(last, ivec2(drawn[at.z].zw)));
}

// Texels outside of the map count as empty (depth 1), and so do blocks that no receiver reads: what the map holds there
// depends on whether it was drawn whole.
vec2 least_depths(ivec3 at) {
  if (!is_drawn(at)) return vec2(1.0);
  // Rows of six texels, from the one before the block to the one after it.
  vec4 middle[6];
  vec2 ends[6];
  Light light = with_layer(frame_light(), at.z);
  for (int j = 0; j < 3; ++j) {
    vec4 cells[3];
    for (int i = 0; i < 3; ++i) {
      cells[i] = gather_stored(vec2(at.xy * 4 + 2 * ivec2(i, j)), light);
    }
    middle[2 * j] = vec4(cells[0].z, cells[1].wz, cells[2].w);
    ends[2 * j] = vec2(cells[0].w, cells[2].z);
    middle[2 * j + 1] = vec4(cells[0].y, cells[1].xy, cells[2].x);
    ends[2 * j + 1] = vec2(cells[0].x, cells[2].y);
  }
  vec2 heights = stored_edge_heights(light);
  vec4 least = vec4(1.0), edges = vec4(1.0);
  for (int row = 0; row < 5; ++row) edges = min(edges, depths_at_edges(middle[row], middle[row + 1], heights.y));
  vec4 right, beyond;
  for (int row = 1; row < 5; ++row) {
    vec4 texels = middle[row];
    least = min(least, texels);
    edges = min(edges, depths_at_edges(texels, vec4(ends[row].x, texels.xyz), heights.x));
    right[row - 1] = texels.w;
    beyond[row - 1] = ends[row].y;
  }
  edges = min(edges, depths_at_edges(right, beyond, heights.x));
  return vec2(least_of(least), least_of(edges));
}
#else
layout(binding = 0, rg32f) uniform readonly restrict image2DArray source;

vec2 least_depths(ivec3 at) {
  ivec3 low = ivec3(at.xy * 2, at.z);
  ivec2 last = imageSize(source).xy - 1;
  vec2 a = imageLoad(source, low).xy;
  vec2 b = imageLoad(source, ivec3(min(low.x + 1, last.x), low.yz)).xy;
  vec2 c = imageLoad(source, ivec3(low.x, min(low.y + 1, last.y), low.z)).xy;
  vec2 d = imageLoad(source, ivec3(min(low.xy + 1, last), low.z)).xy;
  return min(min(a, b), min(c, d));
}
#endif

void main() {
  ivec3 at = ivec3(gl_GlobalInvocationID);
  at.xy += ivec2(drawn[at.z].xy) >> level_shift;
  if (any(greaterThanEqual(at.xy, imageSize(level).xy))) return;
  imageStore(level, at, vec4(least_depths(at), 0.0, 0.0));
}
