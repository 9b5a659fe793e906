// Computes the two finest levels of a layer's depth pyramid: each invocation reads 8 × 8 texels of the shadow map with
// the row around them, and writes their 2 × 2 blocks.
#include "shadow/depth_blocks.glsl"

uniform bool border_is_edge;  // of the map: beyond it nothing is taken to lie

// A row of eight texels, with the one before them and the one after them.
struct Row {
  vec4 left, right;
  vec2 ends;
};

// What is known so far of two blocks side by side.
struct Blocks {
  vec4 least_left, least_right;
  vec4 edges_left, edges_right;
};

// The lesser depth of each of four pairs of neighbours that make an edge, 1 for others.
vec4 depths_at_edges(vec4 a, vec4 b, float height) {
  return mix(vec4(1.0), min(a, b), greaterThan(abs(a - b), vec4(height)));
}

void add_edges_between(Row row, Row next, float height, inout Blocks two) {
  two.edges_left = min(two.edges_left, depths_at_edges(row.left, next.left, height));
  two.edges_right = min(two.edges_right, depths_at_edges(row.right, next.right, height));
}

void add_row(Row row, float height, inout Blocks two) {
  two.least_left = min(two.least_left, row.left);
  two.least_right = min(two.least_right, row.right);
  vec4 up_to_left = depths_at_edges(vec4(row.ends.x, row.left.xyz), row.left, height);
  vec4 up_to_right = depths_at_edges(vec4(row.left.w, row.right.xyz), row.right, height);
  float last = depths_at_edges(row.right, vec4(row.ends.y), height).w;
  // The edge between both blocks, up_to_right.x, counts for each of them.
  two.edges_left = min(min(two.edges_left, up_to_left), up_to_right.xxxx);
  two.edges_right = min(min(two.edges_right, up_to_right), vec4(last));
}

// The two rows that meet at a corner of texels, from the texel before the corner on. Texels outside of the map are as
// those at its border.
void read_rows(ivec2 corner, Light light, out Row row, out Row next) {
  vec4 cells[5];
  for (int i = 0; i < 5; ++i) cells[i] = gather_stored(vec2(corner + ivec2(2 * i, 0)), light);
  row.left = vec4(cells[0].z, cells[1].wz, cells[2].w);
  row.right = vec4(cells[2].z, cells[3].wz, cells[4].w);
  row.ends = vec2(cells[0].w, cells[4].z);
  next.left = vec4(cells[0].y, cells[1].xy, cells[2].x);
  next.right = vec4(cells[2].y, cells[3].xy, cells[4].x);
  next.ends = vec2(cells[0].x, cells[4].y);
}

bool meets_border(ivec2 block) {
  return any(equal(block, ivec2(0))) || any(greaterThan(4 * block + 4, last_texel()));
}

// Least depth of a block, and the least beside an edge. Blocks that no receiver reads count as empty: what the map
// holds there depends on whether it was drawn whole.
vec2 least_depths(ivec2 block, vec4 least, vec4 edges) {
  if (!is_drawn(block)) return vec2(1.0);
  float depth = least_of(least), beside_edges = least_of(edges);
  return vec2(depth, border_is_edge && meets_border(block) ? min(depth, beside_edges) : beside_edges);
}

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
    Blocks two = Blocks(vec4(1.0), vec4(1.0), vec4(1.0), vec4(1.0));
    add_edges_between(a, b, heights.y, two);
    add_row(b, heights.x, two);
    read_rows(corner + ivec2(0, 2), light, c, d);
    add_edges_between(b, c, heights.y, two);
    add_row(c, heights.x, two);
    add_edges_between(c, d, heights.y, two);
    add_row(d, heights.x, two);
    read_rows(corner + ivec2(0, 4), light, a, b);
    add_edges_between(d, a, heights.y, two);
    add_row(a, heights.x, two);
    add_edges_between(a, b, heights.y, two);
    vec2 left = least_depths(block, two.least_left, two.edges_left);
    vec2 right = least_depths(block + ivec2(1, 0), two.least_right, two.edges_right);
    imageStore(blocks, ivec3(block, layer), vec4(left, 0.0, 0.0));
    imageStore(blocks, ivec3(block.x + 1, block.y, layer), vec4(right, 0.0, 0.0));
    least = min(least, min(left, right));
    corner.y += 4;
    ++block.y;
  } while (block.y < 2 * at.y + 2);
  imageStore(squares, ivec3(at, layer), vec4(least, 0.0, 0.0));
}
