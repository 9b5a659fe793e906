// The texels of a layer of the map: where they lie, and what their depths are.
#ifndef READS_ALL
#define READS_ALL 1  // 0: no receiver reads beyond the rim of a lamp's map that sees it, or the second layer
#endif
#include "shadow/projection/light_space.glsl"

// Light-space depth, metres, for a depth as stored in the map.
float stored_depth(float stored, LayerBlock map) {
  precise float depth = map.near_depth + map.depth_range * stored;
  return depth;
}
vec4 stored_depths(vec4 stored, LayerBlock map) {
  precise vec4 depths = map.near_depth + map.depth_range * stored;
  return depths;
}
float stored_depth(float stored, Light light) { return stored_depth(stored, light.map); }

ivec2 last_texel() { return ivec2(shadow.map_size) - 1; }

// Depth as the light's layer stores it, for a depth in light space, metres; and the same for differences of depths.
float stored_of(float depth, Light light) { return (depth - light.map.near_depth) / light.map.depth_range; }
float stored_difference(float difference, Light light) { return difference / light.map.depth_range; }
float stored_metres(Light light) { return light.map.depth_range; }  // from 0 to 1

// What filtered maps hold of a depth, 0 to 1: for a sun what the map stores. Most of what a lamp's map can store are
// depths near the lamp, so that far from it a caster and its shadow would hardly differ. For a lamp it is the logarithm
// of the share of the far plane's depth, 0 up to 1/2000 of it: the library's own maps have no nearer near plane.
const float lamp_depth_logarithm = 7.6009025;  // of 2000

// For a depth as stored in the map.
float filtered_of_stored(float stored) {
  if (!is_lamp) return stored;
  LayerBlock map = shadow.layers[0];
  float share = (map.near_depth + map.depth_range) / (map.near_depth + map.depth_range * stored);
  return max(1.0 + log(share) / lamp_depth_logarithm, 0.0);
}

// For a depth in light space, metres; and for little differences from a receiver's depth.
float filtered_of(float depth, Light light) {
  if (!is_lamp) return stored_of(depth, light);
  LayerBlock map = shadow.layers[0];
  float before_lamp = max(2.0 * light.depth - depth, 1e-6 * light.depth);
  float share = -(map.near_depth + map.depth_range) * light.depth * light.depth / before_lamp;
  return max(1.0 + log(share) / lamp_depth_logarithm, 0.0);
}

float filtered_difference(float difference, Light light) {
  return is_lamp ? difference / (light.depth * lamp_depth_logarithm) : stored_difference(difference, light);
}

// Beyond the rim of a cube's face the map goes on in the faces there. Their texels lie elsewhere, so that what is read
// of one is a depth and its own place. Beyond the rim of a spot's single map, a caster which the rim shows nearer to
// the lamp than what the map is wide enough for is taken to go on as it is there.

// Whether something is read beyond a rim, and whether in other faces. Macros, not functions: of a function drivers see
// that it is false in programs for suns only after they have inlined all that is behind it, wherever a texel is read.
#define reads_beyond_rim (READS_ALL != 0 && is_lamp)
#define has_faces(light) (reads_beyond_rim && (light).layers > 1)

bool leaves_map(ivec2 low, ivec2 high) {
  return any(lessThan(low, ivec2(0))) || any(greaterThan(high, last_texel()));
}

// A texel of the face that sees a place beyond the rim of the light's layer.
struct FaceTexel {
  ivec3 at;   // and its layer
  vec3 seen;  // the direction of its centre as the light's layer sees it: 1 along the axis of its own face
};

FaceTexel face_texel_at(ivec2 texel, Light light) {
  LayerBlock map = shadow.layers[0];  // of all faces
  vec2 tangents = ((vec2(texel) + 0.5) / shadow.map_size - 0.5) / map.widths_per_metre;
  vec3 direction = from_face(vec3(tangents, 1.0), light.layer);
  int face = faces_of(direction).x;
  vec3 there = seen_by_face(direction, face);
  vec2 place = (there.xy / there.z * map.widths_per_metre + 0.5) * shadow.map_size;
  ivec2 at = clamp(ivec2(floor(place)), ivec2(0), last_texel());
  tangents = ((vec2(at) + 0.5) / shadow.map_size - 0.5) / map.widths_per_metre;
  vec3 seen = seen_by_face(from_face(vec3(tangents, 1.0), face), light.layer);
  const float least = 1e-3;  // towards places that lie beside the lamp, not before it
  return FaceTexel(ivec3(at, face), vec3(seen.xy, max(seen.z, least)));
}

// Its stored depth as the light's layer would store it. Faces store −1 over depths along their own axes.
float stored_in_face(sampler2DArray map, FaceTexel texel) {
  float stored = texelFetch(map, texel.at, 0).x;
  LayerBlock block = shadow.layers[0];
  float along = stored_depth(stored, block) / texel.seen.z;
  return stored < 1.0 ? (along - block.near_depth) / block.depth_range : 1.0;
}

// Stored depth beyond the rim, of which `at_rim` is the nearest texel's: 1 where there are no casters.
float stored_beyond(sampler2DArray map, ivec2 texel, float at_rim, Light light) {
  if (has_faces(light)) return stored_in_face(map, face_texel_at(texel, light));
  LayerBlock block = shadow.layers[0];
  float widest = -1.0 / clear_distance(shadow.light_extent);
  return stored_depth(at_rim, block) < widest ? at_rim : 1.0;
}

// Stored depth in a texel of the light's layer of a map, or beyond its rim.
float stored_in(sampler2DArray map, ivec2 texel, Light light) {
  ivec2 within = clamp(texel, ivec2(0), last_texel());
  float stored = texelFetch(map, ivec3(within, light.layer), 0).x;
  if (within == texel) return stored;
  return reads_beyond_rim ? stored_beyond(map, texel, stored, light) : 1.0;
}

float stored_at(ivec2 texel, Light light) { return stored_in(shadow_depth, texel, light); }

// Width of a texel of the light's layer at a position's depth, metres, or its height where that is larger.
float texel_size_at(vec3 position, Light light) { return light.map.texel; }
float texel_size(Receiver receiver, Light light) { return texel_size_at(receiver.position, light); }

// Width and height of a texel, metres.
vec2 texel_extent_at(vec3 position, Light light) { return light.map.texel * light.map.texel_shares; }
vec2 texel_extent(Receiver receiver, Light light) { return texel_extent_at(receiver.position, light); }

// Whether texels are smaller for receivers nearer to the light; and their extent where they are largest, metres.
bool texels_vary() { return is_lamp; }
vec2 largest_texel_extent(Receiver receiver, Light light) {
  if (!is_lamp) return texel_extent(receiver, light);
  LayerBlock map = shadow.layers[0];
  return map.texel * map.texel_shares / -(map.near_depth + map.depth_range);
}

// Slope of the receiver's plane in depth per width of a texel, over texel_size().
float texel_slope(Receiver receiver, Light light) { return length(receiver.gradient * light.map.texel_shares); }

// Upper bound of the error along the light that rounding in the map, in light space and in the receiver's depth causes,
// metres.
float depth_rounding(Receiver receiver, Light light) {
  const float texels_beside = 2.0;  // that are compared with the plane of a receiver without blockers
  float rounding = light.map.rounding + light.map.position_rounding + receiver.depth_error;
  rounding += texels_beside * receiver.depth_tilt * texel_size(receiver, light);
  return is_lamp ? rounding + 1e-6 * (length(shadow.lamp.xyz) + length(receiver.from_lamp)) : rounding;
}

// Map coordinates of a position in the light's layer, in texels; texel centres are at half-integers.
vec2 map_place(vec3 position, Light light) {
  return ((position.xy - light.map.center) * light.map.widths_per_metre + 0.5) * shadow.map_size;
}

// An offset in texels of the light's layer.
vec2 map_offset(vec2 offset, Light light) { return offset * (light.map.widths_per_metre * shadow.map_size); }

// Depth in a texel of the light's layer of a map, or beyond its rim, metres: where there are no casters it is the far
// plane's, as where the sampler's border is read.
float depth_in(sampler2DArray map, ivec2 texel, Light light) {
  return stored_depth(stored_in(map, texel, light), light);
}

float depth_at(ivec2 texel, Light light) { return depth_in(shadow_depth, texel, light); }

// Offset from the receiver of the centre of a texel, beyond the rim of a cube's face of what is read there.
vec2 texel_offset(Receiver receiver, ivec2 texel, Light light) {
  if (has_faces(light) && leaves_map(texel, texel)) {
    vec3 seen = face_texel_at(texel, light).seen;
    return seen.xy * (light.depth / seen.z) - receiver.position.xy;
  }
  vec2 extent = texel_extent(receiver, light);
  vec2 center = (vec2(texel) + 0.5) * extent - 0.5 / light.map.widths_per_metre + light.map.center;
  return center - receiver.position.xy;
}

// Offsets of four texels' centres from the receiver.
struct Offsets {
  vec4 x, y;
};

// Four texels around a point of the map, in the order of textureGather: (0,1) (1,1) (1,0) (0,0).
struct Footprint {
  vec4 depths;  // metres
  Offsets offsets;
  vec2 weight;  // bilinear, of the texels with the higher coordinate
};

// Stored depths of the four texels of a map around map coordinates.
vec4 gather_stored_in(sampler2DArray map, vec2 place, Light light) {
  return textureGather(map, vec3(place * light.map.texel_uv, float(light.layer)));
}

vec4 gather_stored(vec2 place, Light light) { return gather_stored_in(shadow_depth, place, light); }

// Depths, metres, of the texels `first` to first + (1, 1), in the order of a Footprint; outside of the map, its far
// plane's.
vec4 depths_from(ivec2 first, Light light) {
  return stored_depths(gather_stored(vec2(first + 1), light), light.map);
}

// A point at an offset from the receiver, in texels from the centre of the map's first texel.
vec2 texel_place(Receiver receiver, vec2 offset, Light light) {
  return map_place(receiver.position, light) - 0.5 + map_offset(offset, light);
}

// Offsets of the four texels around a point at that offset, of which the last lies at a bilinear weight's distance.
Offsets footprint_offsets(Receiver receiver, vec2 offset, vec2 weight, Light light) {
  vec2 texel = texel_extent(receiver, light);
  vec2 low = offset - weight * texel;
  vec2 high = low + texel;
  return Offsets(vec4(low.x, high.x, high.x, low.x), vec4(high.y, high.y, low.y, low.y));
}

// Four texels of which some lie beyond the rim.
Footprint footprint_beyond(Receiver receiver, ivec2 first, vec2 weight, Light light) {
  Footprint found;
  for (int i = 0; i < 4; ++i) {
    ivec2 texel = first + ivec2(i == 1 || i == 2, i < 2);
    found.depths[i] = depth_at(texel, light);
    vec2 offset = texel_offset(receiver, texel, light);
    found.offsets.x[i] = offset.x;
    found.offsets.y[i] = offset.y;
  }
  found.weight = weight;
  return found;
}

// The texels `first` to first + (1, 1), of which the last lies at a distance of `weight` texels from a point at that
// offset.
Footprint footprint_from(Receiver receiver, ivec2 first, vec2 offset, vec2 weight, Light light) {
  if (reads_beyond_rim && leaves_map(first, first + 1)) return footprint_beyond(receiver, first, weight, light);
  return Footprint(depths_from(first, light), footprint_offsets(receiver, offset, weight, light), weight);
}

Footprint fetch_footprint(Receiver receiver, vec2 offset, Light light) {
  vec2 at = texel_place(receiver, offset, light);
  vec2 first = floor(at);
  return footprint_from(receiver, ivec2(first), offset, at - first, light);
}

// How much deeper than the receiver its plane lies at offsets, metres.
vec4 plane_depths(Receiver receiver, Offsets at) { return receiver.gradient.x * at.x + receiver.gradient.y * at.y; }

// The texel that contains a point, or what is read there beyond the rim of a cube's face.
struct PointTexel {
  float depth;  // metres
  vec2 offset;  // of its centre from the receiver, metres
};

PointTexel fetch_texel(Receiver receiver, vec2 offset, Light light) {
  vec2 at = map_place(receiver.position, light) + map_offset(offset, light);
  vec2 first = floor(at);
  ivec2 texel = ivec2(first);
  vec2 center = offset + (first + 0.5 - at) * texel_extent(receiver, light);
  if (has_faces(light) && leaves_map(texel, texel)) center = texel_offset(receiver, texel, light);
  return PointTexel(depth_at(texel, light), center);
}

// The share of the four texels around a point that lie at or behind the receiver's plane less the bias, weighted
// bilinearly: one fetch of a sampler that compares and filters. It compares all four with one depth, the least of the
// plane at their centres: with a greater one, a lit plane would shadow itself.
float compared_share(sampler2DArrayShadow map, Receiver receiver, vec2 offset, float bias, Light light) {
  vec2 at = texel_place(receiver, offset, light);
  ivec2 first = ivec2(floor(at));
  bool beyond = reads_beyond_rim && leaves_map(first, first + 1);
  Footprint found = Footprint(vec4(0.0), footprint_offsets(receiver, offset, fract(at), light), fract(at));
  if (beyond) found = footprint_beyond(receiver, first, fract(at), light);
  vec4 plane = plane_depths(receiver, found.offsets);
  float depth = receiver.position.z + min(min(plane.x, plane.y), min(plane.z, plane.w)) - bias;
  if (beyond) {
    vec4 lit = step(vec4(depth), found.depths);
    vec2 rows = mix(lit.wx, lit.zy, found.weight.x);
    return mix(rows.x, rows.y, found.weight.y);
  }
  vec4 place = vec4((at + 0.5) * light.map.texel_uv, float(light.layer), min(stored_of(depth, light), 1.0));
  return textureGrad(map, place, vec2(0.0), vec2(0.0));  // there are no derivatives in compute shaders
}
