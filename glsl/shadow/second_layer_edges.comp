// Computes the two finest levels of the pyramid of a layer's second surfaces: where they end above something lower.
#include "shadow/depth_blocks.glsl"
#include "shadow/second_layer.glsl"

// A row of eight texels, left and right. What lies lowest is the second surface, or the first where that is the only
// one; `before` and `after`: of the texels next to the row.
struct Row {
  vec4 first[2], second[2], lowest[2];
  float before, after;
};

void set_lowest(inout Row row, vec2 first_ends, vec2 second_ends) {
  for (int i = 0; i < 2; ++i) row.lowest[i] = mix(row.first[i], row.second[i], lessThan(row.second[i], vec4(1.0)));
  vec2 ends = mix(first_ends, second_ends, lessThan(second_ends, vec2(1.0)));
  row.before = ends.x;
  row.after = ends.y;
}

// The two rows that meet at a corner of texels. Texels outside of the map have the second surface of those at its
// border, and so no edge is found there.
void read_rows(ivec2 corner, Light light, out Row row, out Row next) {
  vec4 first[5], second[5];
  for (int i = 0; i < 5; ++i) {
    vec2 place = vec2(corner + ivec2(2 * i, 0));
    first[i] = gather_stored(place, light);
    second[i] = gather_stored_in(second_layer, place, light);
  }
  row.first = vec4[2](vec4(first[0].z, first[1].wz, first[2].w), vec4(first[2].z, first[3].wz, first[4].w));
  row.second = vec4[2](vec4(second[0].z, second[1].wz, second[2].w), vec4(second[2].z, second[3].wz, second[4].w));
  next.first = vec4[2](vec4(first[0].y, first[1].xy, first[2].x), vec4(first[2].y, first[3].xy, first[4].x));
  next.second = vec4[2](vec4(second[0].y, second[1].xy, second[2].x), vec4(second[2].y, second[3].xy, second[4].x));
  set_lowest(row, vec2(first[0].w, first[4].z), vec2(second[0].w, second[4].z));
  set_lowest(next, vec2(first[0].x, first[4].y), vec2(second[0].x, second[4].y));
}

// What is known so far of two blocks side by side: see main().
struct Blocks {
  vec4 limits[2], edges[2];
};

const Blocks nothing = Blocks(vec4[2](vec4(1.0), vec4(1.0)), vec4[2](vec4(1.0), vec4(1.0)));

// Adds four texels whose lowest neighbours in rows and columns have these depths, less what makes an edge.
void add_texels(vec4 first, vec4 second, vec4 neighbours, inout vec4 limits, inout vec4 edges) {
  const float steepness = least_share_of_height / (1.0 - least_share_of_height);
  bvec4 ends = lessThan(second, neighbours);
  edges = min(edges, mix(vec4(1.0), second, ends));
  limits = min(limits, mix(vec4(1.0), -(second + steepness * (second - first)), ends));
}

void add_row(Row above, Row row, Row below, vec2 heights, inout Blocks two) {
  vec4 left = row.lowest[0], right = row.lowest[1];
  vec4 beside_left = max(vec4(row.before, left.xyz), vec4(left.yzw, right.x)) - heights.x;
  vec4 beside_right = max(vec4(left.w, right.xyz), vec4(right.yzw, row.after)) - heights.x;
  add_texels(row.first[0], row.second[0], max(beside_left, max(above.lowest[0], below.lowest[0]) - heights.y),
             two.limits[0], two.edges[0]);
  add_texels(row.first[1], row.second[1], max(beside_right, max(above.lowest[1], below.lowest[1]) - heights.y),
             two.limits[1], two.edges[1]);
}

// x: the negated greatest depth of receivers to which such an edge matters, 1 if there is none: to deeper ones the
// first surface is not much higher than the second. y: the least depth of such an edge.
void main() {
  ivec2 at = (drawn.xy >> 3) + ivec2(gl_GlobalInvocationID);
  if (any(greaterThanEqual(at, imageSize(squares).xy))) return;
  Light light = with_layer(frame_light(), layer);
  vec2 heights = stored_edge_heights(light);
  ivec2 block = 2 * at, corner = 8 * at;
  vec2 least = vec2(1.0);
  Row a, b, c, d;
  read_rows(corner, light, a, b);
  do {
    Blocks two = nothing;
    read_rows(corner + ivec2(0, 2), light, c, d);
    add_row(a, b, c, heights, two);
    add_row(b, c, d, heights, two);
    read_rows(corner + ivec2(0, 4), light, a, b);
    add_row(c, d, a, heights, two);
    add_row(d, a, b, heights, two);
    for (int i = 0; i < 2; ++i) {
      ivec2 place = block + ivec2(i, 0);
      vec2 found = is_drawn(place) ? vec2(least_of(two.limits[i]), least_of(two.edges[i])) : vec2(1.0);
      imageStore(blocks, ivec3(place, layer), vec4(found, 0.0, 0.0));
      least = min(least, found);
    }
    corner.y += 4;
    ++block.y;
  } while (block.y < 2 * at.y + 2);
  imageStore(squares, ivec3(at, layer), vec4(least, 0.0, 0.0));
}
