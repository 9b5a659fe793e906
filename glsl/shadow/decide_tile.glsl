// Decides tiles of 8 × 8 pixels that no penumbra reaches: where the shadow map has no edge within the disc that can
// block light from a tile's receivers, it shows one surface there, and each receiver lies either on that surface and is
// lit, or below it and is in shadow.
#include "lib/rows.glsl"
#include "shadow/decide.glsl"
#include "shadow/second_layer.glsl"
#include "shadow/drivers/tiles.glsl"
#include "shadow/drivers/tile_lists.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform int row_step;  // see tile_of_invocation()

// The pixels of a tile, low to high exclusive.
struct Pixels {
  ivec2 low, high;
};

// The pixel after one of them, row by row; above them after the last one.
ivec2 next_pixel(ivec2 at, Pixels pixels) { return next_in_rows(at, pixels.low.x, pixels.high.x - 1, 1); }

vec2 depth_range(Pixels pixels) {
  vec2 range = vec2(2.0, -1.0);
  ivec2 at = pixels.low;
  do {
    float depth = texelFetch(receiver_depth, at, 0).x;
    if (depth != shadow.sky_depth) range = vec2(min(range.x, depth), max(range.y, depth));
    at = next_pixel(at, pixels);
  } while (at.y < pixels.high.y);
  return range;
}

// False if a corner lies at the camera or behind it, where corners bound nothing: under an oblique near plane, the
// depth of one pixel may mean that in another.
bool find_hull(Pixels pixels, vec2 range, out Hull hull) {
  bool before_camera = true;
  for (int corner = 0; corner < 8; ++corner) {
    bvec3 high = notEqual(ivec3(corner) & ivec3(1, 2, 4), ivec3(0));
    vec2 pixel = mix(vec2(pixels.low), vec2(pixels.high), high.xy);
    vec4 view = unproject_with_w(pixel, high.z ? range.y : range.x);
    before_camera = before_camera && view.w > 0.0;
    hull.corners[corner] = light_position(view.xyz / view.w);
  }
  return before_camera;
}

// Bounds of what search_radius() gives the receivers of a box, metres. It reads the texels of the pyramid that a disc
// around a receiver touches. Such discs touch at least what the disc touches that they have in common, in texels that
// are as wide or wider, and at most what a disc touches that contains them all.
struct SearchRadii {
  float least, most;
};

SearchRadii search_radii(Receiver shallowest, Receiver deepest, float box_radius, Light widest) {
  float near_disc = penumbra_radius(shallowest, shallowest.position.z - least_depth(widest), widest);
  float far_disc = penumbra_radius(deepest, deepest.position.z - least_depth(widest), widest);
  float footprint = 1.5 * texel_size(deepest, widest);
  float all = far_disc + footprint + box_radius;
  float nearest = bounds_near(deepest.position, all, widest).least;
  SearchRadii radii;
  radii.most = min(far_disc, penumbra_radius(deepest, deepest.position.z - nearest, widest));
  radii.least = 0.0;
  float shared_disc = near_disc + footprint - box_radius;
  if (shared_disc > 0.0) {
    int level = disc_level(shallowest.position, near_disc + footprint, widest);
    nearest = level_bounds(shallowest.position, shared_disc, level, widest).least;
    radii.least = min(near_disc, penumbra_radius(shallowest, shallowest.position.z - nearest, widest));
    // Some techniques narrow it by finer texels: see fine_search_radius().
    nearest = depth_bounds(shallowest.position, vec2(max(radii.least + footprint - box_radius, 0.0)), widest).least;
    radii.least = min(radii.least, penumbra_radius(shallowest, shallowest.position.z - nearest, widest));
  }
  return radii;
}

// The layers that the box's receivers read, two at a seam: the verdict must hold in all of them.
struct Layers {
  int first, last;
  bool outside;  // some lie in none
};

Layers layers_of(Receiver shallowest, Receiver deepest, SearchRadii radii, float box_radius, Light light) {
  Layers layers = Layers(light.layer, light.layer, false);
  if (is_lamp) return layers;
  layers.first = finest_layer(shallowest, radii.least - box_radius, light);
  layers.last = finest_layer(deepest, radii.most + box_radius, light);
  float edge = layer_edge(layers.last, deepest.position, radii.most + box_radius, light);
  if (layers.last == light.layers - 1) {
    layers.outside = edge > 1.0;
  } else if (cascades_seam != cascades_seam_none && edge > 1.0 - cascades_blend) {
    layers.last = next_layer(layers.last, deepest.position, radii.most + box_radius, light);
  }
  return layers;
}

// Radius, metres, of the disc outside of which nothing can block light from a box's receivers, of which this is the one
// that is farthest from the light. Techniques may read wider discs, whose bounds are coarser: see SearchRadii.
float most_blocking_radius(Receiver deepest, vec2 half_widths, Light light) {
  Light widest = with_widest_layer(deepest, light);
  float widest_radius = penumbra_radius(deepest, deepest.position.z - least_depth(widest), light);
  vec2 margins = half_widths + (2.0 + bias_normal_offset) * texel_size(deepest, widest);
  float nearest = depth_bounds(deepest.position, margins + widest_radius, widest).least;
  return min(widest_radius, penumbra_radius(deepest, deepest.position.z - nearest, light));
}

// What is known of a tile so far.
struct TileState {
  uvec2 decided;  // bits as in Decision::lit: pixels that one layer has decided
  int covered, away;
  float distance_sum;
  Decision decision;
};

// Adds a pixel. False if it was decided in another way before.
bool add(inout TileState tile, int bit, PixelState state) {
  uint mask = 1u << (bit & 31), is_lit = uint(state.kind == lit) << (bit & 31);
  if ((tile.decided[bit >> 5] & mask) != 0u) return (tile.decision.lit[bit >> 5] & mask) == is_lit;
  tile.decided[bit >> 5] |= mask;
  tile.decision.lit[bit >> 5] |= is_lit;
  tile.covered += int(state.kind == in_shadow);
  tile.away += int(state.kind == faces_away);
  if (state.kind == in_shadow) tile.distance_sum += state.blocker_distance;
  return true;
}

int bit_of(Pixels pixels, ivec2 at) { return tile_size * (at.y - pixels.low.y) + at.x - pixels.low.x; }

// Adds what the light's layer shows. False if it leaves a pixel undecided, or differs from another layer.
bool decide(Pixels pixels, Light light, inout TileState tile) {
  bool decided = true;
  ivec2 at = pixels.low;
  do {
    PixelState state = decide_pixel(at, light);
    if (state.kind == undecided) {
      decided = false;
    } else if (state.kind != unseen) {
      decided = add(tile, bit_of(pixels, at), state);
    }
    at = next_pixel(at, pixels);
  } while (decided && at.y < pixels.high.y);
  return decided && (tile.covered == 0 || tile.away == 0);
}

// The same if the light shines on none of the pixels.
bool decide_out_of_reach(Pixels pixels, inout TileState tile) {
  bool out_of_reach = true;
  ivec2 at = pixels.low;
  do {
    bool sky = is_sky(at);
    out_of_reach = sky || !faces_light(receiver_at(at));
    if (out_of_reach) add(tile, bit_of(pixels, at), PixelState(sky ? lit : faces_away, 0.0));
    at = next_pixel(at, pixels);
  } while (out_of_reach && at.y < pixels.high.y);
  return out_of_reach;
}

// The same for all layers in which receivers of a box are read.
bool decide_box(Pixels pixels, Box box, Light light, inout TileState tile) {
  vec2 half_widths = 0.5 * (box.high.xy - box.low.xy);
  float box_radius = max(half_widths.x, half_widths.y);
  Receiver deepest = receiver_in_box(box, box.high.z, light);
  Light widest = with_widest_layer(deepest, light);
  float radius = most_blocking_radius(deepest, half_widths, light);
  Receiver shallowest = receiver_in_box(box, box.low.z, light);
  SearchRadii radii = search_radii(shallowest, deepest, box_radius, widest);
  Layers layers = layers_of(shallowest, deepest, radii, box_radius, light);
  if (layers.outside) return false;
  tile.decision.radius = max(tile.decision.radius, radius);
  light.read_radius = radius;
  bool decided = true;
  int layer = layers.first;
  do {
    light = with_layer(light, layer);
    decided = edges_are_clear(deepest, radius, half_widths, light) && decide(pixels, light, tile);
  } while (decided && ++layer <= layers.last);
  // The decision names the finest layer.
  if (decided) tile.decision.layer = layers.first;
  return decided;
}

// Texels beyond the disc of search_radius() that techniques read: must match src/shadow/light_projection.h.
const float read_margin = 8.0;

// Whether a receiver of the hull may read texels beyond the rim of a map that sees it.
bool may_read_beyond_rim(Hull hull) {
  if (!reads_beyond_rim) return false;
  for (int left = sights_of(hull); left != 0; left &= left - 1) {
    Box box;
    Light light = frame_light();
    if (!box_of(hull, findLSB(left), box, light)) return true;
    Receiver deepest = receiver_in_box(box, box.high.z, light);
    Receiver shallowest = receiver_in_box(box, box.low.z, light);
    vec2 half_widths = 0.5 * (box.high.xy - box.low.xy);
    Light widest = with_widest_layer(deepest, light);
    float radius = search_radii(shallowest, deepest, max(half_widths.x, half_widths.y), widest).most;
    if (reaches_rim(box, radius, read_margin + 1.0 + bias_normal_offset, light)) return true;
  }
  return false;
}

#if maps_layers == 2
layout(binding = UNIT_second_layer_edges) uniform sampler2DArray second_layer_edges;

const float least_overlap = 1e-3;  // pixels: of a penumbra whose width is not known, or 0

// Whether a surface of the second layer ends where that matters to receivers within these half widths: `deepest` and
// `shallowest` are those farthest from the light and nearest to it. `radius`: bounds their discs.
bool second_layer_ends(Receiver deepest, Receiver shallowest, float radius, vec2 half_widths, Light light) {
  float margin = (2.0 + bias_normal_offset) * texel_size(deepest, light);
  int i = 0;
  do {
    vec2 stored = least_in_rectangle(second_layer_edges, deepest.position, half_widths + radius + margin, light);
    bool matters = stored_depth(-stored.x, light) > shallowest.position.z;
    radius = matters ? narrowed_radius(deepest, radius, stored_depth(stored.y, light), light) : 0.0;
  } while (++i < 3 && radius > 0.0);
  return radius > 0.0;
}

// Whether a surface of the second layer lies above a pixel that the light's layer shows, and well below the first one.
bool is_below_second_layer(ivec2 pixel, Light light) {
  if (is_sky(pixel)) return false;
  Receiver receiver = receiver_at(pixel);
  if (!faces_light(receiver) || is_outside(receiver) || !reads_layer(receiver, light)) return false;
  receiver = seen_by_layer(receiver, light.layer);
  light = own_light(receiver, light);
  receiver = offset_receiver(receiver, light);
  vec2 at = texel_place(receiver, vec2(0.0), light), first = floor(at);
  Offsets offsets = footprint_offsets(receiver, vec2(0.0), at - first, light);
  vec4 heights = heights_above(receiver, depths_behind(ivec2(first), light), offsets);
  vec4 most = least_share_of_height * heights_above(receiver, depths_from(ivec2(first), light), offsets);
  vec4 is_lower = vec4(lessThan(heights, most));
  return any(greaterThan(is_lower * heights, vec4(depth_bias(receiver, light))));
}

// The width in pixels of the widest penumbra of a box in which casters may overlap, so that the second layer hides
// light which the first one does not; 0 if they do not. They do not where no surface of the second layer ends, and no
// receiver lies below one.
float overlap_in(Pixels pixels, Box box, Light light) {
  vec2 half_widths = 0.5 * (box.high.xy - box.low.xy);
  float box_radius = max(half_widths.x, half_widths.y);
  Receiver deepest = receiver_in_box(box, box.high.z, light);
  Receiver shallowest = receiver_in_box(box, box.low.z, light);
  Light widest = with_widest_layer(deepest, light);
  float radius = most_blocking_radius(deepest, half_widths, light);
  SearchRadii radii = search_radii(shallowest, deepest, box_radius, widest);
  Layers layers = layers_of(shallowest, deepest, radii, box_radius, light);
  bool overlap = false;
  int layer = layers.first;
  do {
    light = with_layer(light, layer);
    overlap = overlap || second_layer_ends(deepest, shallowest, radius, half_widths, light);
    ivec2 at = pixels.low;
    do {
      overlap = overlap || is_below_second_layer(at, light);
      at = next_pixel(at, pixels);
    } while (!overlap && at.y < pixels.high.y);
  } while (!overlap && ++layer <= layers.last);
  if (!overlap) return 0.0;
  return is_lamp ? least_overlap : max(2.0 * radius / pixel_width(view_position_of(deepest)), least_overlap);
}

// The same for a tile.
float overlap_in(Pixels pixels, Hull hull) {
  float width = 0.0;
  for (int left = sights_of(hull); left != 0; left &= left - 1) {
    Box box;
    Light light = frame_light();
    bool bounded = box_of(hull, findLSB(left), box, light);
    width = max(width, bounded ? overlap_in(pixels, box, light) : least_overlap);
  }
  return width;
}
#endif

// What becomes of a tile.
const int tile_decided = 0, tile_listed = 1, tile_apart = 2;

// Decides all pixels of a tile, if that is possible. `overlap`: else, the width in pixels of the widest penumbra in
// which casters may overlap; 0 if they do not, or no second layer is read.
int decide_tile(Pixels pixels, out Decision decision, out float overlap) {
  decision = Decision(uvec2(~0u), 0.0, 0.0, 0);
  overlap = 0.0;
  vec2 range = depth_range(pixels);
  if (range.x > range.y) return tile_decided;
  TileState tile = TileState(uvec2(0u), 0, 0, 0.0, Decision(uvec2(0u), 0.0, 0.0, 0));
  Hull hull;
  bool bounded = find_hull(pixels, range, hull);
  bool done = may_be_out_of_reach() && decide_out_of_reach(pixels, tile);
  bool failed = !bounded && !done;
  for (int left = done || failed ? 0 : sights_of(hull); left != 0 && !failed; left &= left - 1) {
    Box box;
    Light light = frame_light();
    failed = !box_of(hull, findLSB(left), box, light) || !decide_box(pixels, box, light, tile);
  }
  decision = tile.decision;
  if (tile.covered > 0) decision.blocker_distance = tile.distance_sum / float(tile.covered);
  ivec2 size = pixels.high - pixels.low;
  bool all_decided = bitCount(tile.decided.x) + bitCount(tile.decided.y) == size.x * size.y;
  if (all_decided && !failed) return tile_decided;
  bool apart = !bounded && reads_beyond_rim || may_read_beyond_rim(hull);
#if maps_layers == 2
  overlap = bounded ? overlap_in(pixels, hull) : least_overlap;
  apart = apart || overlap > 0.0;
#endif
  return apart ? tile_apart : tile_listed;
}

// The pixels of a tile of the viewport.
Pixels pixels_of(ivec2 tile) {
  ivec2 origin = ivec2(shadow.viewport.xy), low = tile * tile_size;
  return Pixels(origin + low, origin + min(low + tile_size, ivec2(shadow.viewport.zw)));
}

// Rows of groups that are far apart follow each other: a software rasteriser gives each of its threads one run of
// groups, and the tiles below a sky take longer than the sky.
ivec2 tile_of_invocation() {
  uvec2 group = uvec2(gl_WorkGroupID.x, gl_WorkGroupID.y * uint(row_step) % gl_NumWorkGroups.y);
  return ivec2(group * gl_WorkGroupSize.xy + gl_LocalInvocationID.xy);
}

bool in_viewport(ivec2 tile) { return all(lessThan(tile * tile_size, ivec2(shadow.viewport.zw))); }
