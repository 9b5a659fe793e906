// Decides tiles of 8 × 8 pixels that no penumbra reaches: where the shadow map has no edge within the disc that can
// block light from a tile's receivers, it shows one surface there, and each receiver lies either on that surface and is
// lit, or below it and is in shadow.
#include "shadow/decide.glsl"
#include "shadow/drivers/tiles.glsl"
#include "shadow/drivers/tile_lists.glsl"

// A box in light space.
struct Box {
  vec3 low, high;
};

// The pixels of a tile, low to high exclusive.
struct Pixels {
  ivec2 low, high;
};

vec2 depth_range(Pixels pixels) {
  vec2 range = vec2(2.0, -1.0);
  for (int y = pixels.low.y; y < pixels.high.y; ++y) {
    for (int x = pixels.low.x; x < pixels.high.x; ++x) {
      float depth = texelFetch(receiver_depth, ivec2(x, y), 0).x;
      if (depth != shadow.sky_depth) range = vec2(min(range.x, depth), max(range.y, depth));
    }
  }
  return range;
}

Box box_of(Pixels pixels, vec2 range) {
  Box box = Box(vec3(1e30), vec3(-1e30));
  for (int corner = 0; corner < 8; ++corner) {
    bvec3 high = notEqual(ivec3(corner) & ivec3(1, 2, 4), ivec3(0));
    vec2 pixel = mix(vec2(pixels.low), vec2(pixels.high), high.xy);
    vec3 position = light_position(unproject(pixel, high.z ? range.y : range.x));
    box.low = min(box.low, position);
    box.high = max(box.high, position);
  }
  return box;
}

// A receiver at the box's centre, at this depth.
Receiver receiver_in_box(Box box, float depth) {
  Receiver receiver;
  receiver.position = vec3(0.5 * (box.low.xy + box.high.xy), depth);
  receiver.normal = vec3(0.0, 0.0, -1.0);
  receiver.gradient = vec2(0.0);
  receiver.surroundings = Surroundings(vec4(0.0), 0.0, 0.0, 0.0);
  receiver.pixel = vec2(0.0);
  receiver.history_refused = false;
  return receiver;
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
  }
  return radii;
}

// The layers that the box's receivers read, two at a seam: the verdict must hold in all of them.
struct Layers {
  int first, last;
  bool outside;  // some lie in none
};

Layers layers_of(Receiver shallowest, Receiver deepest, SearchRadii radii, float box_radius, Light light) {
  Layers layers;
  layers.first = finest_layer(shallowest, radii.least - box_radius, light);
  layers.last = finest_layer(deepest, radii.most + box_radius, light);
  float edge = layer_edge(layers.last, deepest.position, radii.most + box_radius, light);
  if (layers.last == light.layers - 1) {
    layers.outside = edge > 1.0;
  } else if (cascades_seam != cascades_seam_none && edge > 1.0 - cascades_blend) {
    ++layers.last;
  }
  return layers;
}

// Whether all pixels are decided.
bool decide(Pixels pixels, Light light, out Decision decision) {
  decision = Decision(uvec2(0u), 0.0, light.read_radius, light.layer);
  int covered = 0, away = 0;
  float sum = 0.0;
  for (int y = pixels.low.y; y < pixels.high.y; ++y) {
    for (int x = pixels.low.x; x < pixels.high.x; ++x) {
      PixelState state = decide_pixel(ivec2(x, y), light);
      if (state.kind == undecided) return false;
      int bit = tile_size * (y - pixels.low.y) + x - pixels.low.x;
      decision.lit[bit >> 5] |= uint(state.kind == lit) << (bit & 31);
      covered += int(state.kind == in_shadow);
      away += int(state.kind == faces_away);
      if (state.kind == in_shadow) sum += state.blocker_distance;
    }
  }
  if (covered > 0) decision.blocker_distance = sum / float(covered);
  return covered == 0 || away == 0;
}

// Decides all pixels of a tile, if that is possible.
bool decide_tile(Pixels pixels, out Decision decision) {
  decision = Decision(uvec2(~0u), 0.0, 0.0, 0);
  vec2 range = depth_range(pixels);
  if (range.x > range.y) return true;
  Box box = box_of(pixels, range);
  vec2 half_widths = 0.5 * (box.high.xy - box.low.xy);
  float box_radius = max(half_widths.x, half_widths.y);
  Light light = frame_light();
  Receiver deepest = receiver_in_box(box, box.high.z);
  Light widest = with_widest_layer(deepest, light);
  float widest_radius = penumbra_radius(deepest, deepest.position.z - least_depth(widest), light);
  vec2 margins = half_widths + (2.0 + bias_normal_offset) * texel_size(deepest, widest);
  float nearest = depth_bounds(deepest.position, margins + widest_radius, widest).least;
  float radius = min(widest_radius, penumbra_radius(deepest, deepest.position.z - nearest, light));
  Receiver shallowest = receiver_in_box(box, box.low.z);
  SearchRadii radii = search_radii(shallowest, deepest, box_radius, widest);
  Layers layers = layers_of(shallowest, deepest, radii, box_radius, light);
  if (layers.outside) return false;
  light.read_radius = radius;
  // The coarser layer of a seam comes first, so that the decision names the finer one.
  for (int layer = layers.last; layer >= layers.first; --layer) {
    light = with_layer(light, layer);
    if (!edges_are_clear(deepest, radius, half_widths, light)) return false;
    Decision in_layer;
    if (!decide(pixels, light, in_layer)) return false;
    if (layer < layers.last && in_layer.lit != decision.lit) return false;
    decision = in_layer;
  }
  return true;
}

// The pixels of a tile of the viewport.
Pixels pixels_of(ivec2 tile) {
  ivec2 origin = ivec2(shadow.viewport.xy), low = tile * tile_size;
  return Pixels(origin + low, origin + min(low + tile_size, ivec2(shadow.viewport.zw)));
}

bool in_viewport(ivec2 tile) { return all(lessThan(tile * tile_size, ivec2(shadow.viewport.zw))); }
