// The only GLSL file that depends on the kind of light and the projection of its shadow map. It converts positions to
// map coordinates and stored depths to metres, and gives the sizes of texels and penumbrae. All other files work in
// light space:
//   - z is the depth along the light's rays, metres, growing away from the light; the map stores it. x and y are
//     perpendicular to z.
//   - Offsets and radii are metres in x and y at the receiver's depth, for every kind of projection.
//   - A light's shadow map has layers; a receiver reads one of them, or two where it blends between layers.
// A sun has parallel rays, and orthographic cascades as layers. A lamp has perspective maps, one or a cube's faces. For
// each receiver it is a sun: the projective map
//   (x, y, z) -> (x, y, 2 z - Z) · Z / z,   Z the receiver's depth,
// makes the rays through the lamp's centre parallel, keeps planes plane, leaves all points at the receiver's depth
// where they are, and turns a disc of radius R at the lamp into a sun of tangent R / Z. The depth that a perspective
// map stores is a linear function of the result. So the functions below differ in how they place a receiver and its
// map, and in little else. See ADR 24.
#include "shared/cube_faces.h"
#include "shared/shadow_block.h"
#include "lib/kernel.glsl"
#include "lib/projection.glsl"

layout(std140, binding = 1) uniform ShadowData { ShadowBlock shadow; };

layout(binding = 0) uniform sampler2DArray shadow_depth;  // stored depths; one array layer for each layer of the light

// Whether the light is a lamp: a constant in programs that are compiled for one kind of light.
#ifdef LAMP
const bool is_lamp = LAMP != 0;
#else
#define is_lamp (shadow.light_is_lamp != 0)
#endif

// A point to be shaded, in light space.
struct Receiver {
  vec3 position;  // of a lamp: from its centre, in the space of the face that the receiver is seen through
  vec3 normal;    // geometric
  vec2 gradient;  // of its plane: change of depth per metre in x and y
  Surroundings surroundings;
  vec2 pixel;     // seeds the noise
  float depth_error;  // the most by which its plane may be off along the light because depths were rounded, metres
  bool history_refused;  // there is a history, but it is invalid here: techniques take more taps
  int layer;             // of a lamp: the face that sees it so
  vec3 from_lamp;        // position and normal in the lamp's own space
  vec3 lamp_normal;
};

struct Light {
  float extent;  // the tangent of half the angle that it spans, from the receiver
  bool square;   // else a disc
  int layers;
  int layer;          // the one to read; see with_layer()
  LayerBlock map;     // its placement
  float read_radius;  // metres: the technique's read_radius()
  vec3 outline;       // of a lamp, a symmetric matrix, xx yy xy: makes an ellipse on the map of the unit disc
  float depth;        // of a lamp: the receiver's
};

const float max_plane_slope = 1000.0;

// The light as its maps have it, for what no receiver reads.
Light frame_light() {
  return Light(shadow.light_extent, shadow.light_is_square != 0, shadow.layer_count, 0, shadow.layers[0], 0.0,
               vec3(1.0, 1.0, 0.0), 1.0);
}

// A lamp's map as that of a sun, for receivers at this depth.
LayerBlock map_at_depth(LayerBlock map, float depth) {
  map.widths_per_metre /= depth;
  map.texel *= depth;
  map.near_depth = depth * (2.0 + depth * map.near_depth);
  map.depth_range *= depth * depth;
  map.rounding *= depth * depth;
  return map;
}

LayerBlock layer_map(int layer, Light light) {
  LayerBlock map = shadow.layers[layer];
  return is_lamp ? map_at_depth(map, light.depth) : map;
}

// The light with another layer to read. The layer's placement is loaded once here rather than for each texel that is
// read, because the index differs from pixel to pixel, so that each load is slow.
Light with_layer(Light light, int layer) {
  light.layer = layer;
  light.map = layer_map(layer, light);
  return light;
}

// The light as a receiver sees it.
Light light_at(Receiver receiver) {
  Light light = frame_light();
  if (is_lamp) {
    // The nearest depth that is not at the lamp's centre, where there is no light space.
    light.depth = max(receiver.position.z, -1.0 / shadow.layers[0].near_depth);
    light.layer = receiver.layer;
    light.extent = shadow.light_extent / light.depth;
    light.map = map_at_depth(light.map, light.depth);
    // A disc that faces the receiver, seen along the map's axis: longer by 1 / cosine along the direction in which the
    // receiver lies, as it is shown on the lamp's plane by rays from the receiver.
    vec2 across = receiver.position.xy;
    float away = length(vec3(across, light.depth));
    float longer = 1.0 / (light.depth * (away + light.depth));
    light.outline = vec3(1.0 + longer * across * across, longer * across.x * across.y);
  }
  return light;
}

// A point of the light's shape on the map, -1..1 for a disc of radius 1; and back.
vec2 on_outline(vec2 point, Light light) {
  if (!is_lamp) return point;
  return light.outline.xy * point + light.outline.z * point.yx;
}

struct Outline {
  vec4 x, y;
};

Outline from_outline(vec4 x, vec4 y, Light light) {
  if (!is_lamp) return Outline(x, y);
  vec3 m = light.outline;
  float scale = 1.0 / (m.x * m.y - m.z * m.z);
  return Outline(scale * (m.y * x - m.z * y), scale * (m.x * y - m.z * x));
}

// Bounds of the outline of a disc of radius 1, along x and y.
vec2 outline_reach(Light light) {
  if (!is_lamp) return vec2(1.0);
  return sqrt(light.outline.xy * light.outline.xy + light.outline.z * light.outline.z);
}

// Light space and back. Directions of light space are unit where those of the world are.

vec3 light_direction(vec3 world_direction) { return mat3(shadow.world_to_light) * world_direction; }
vec3 view_direction(vec3 light_space_direction) { return light_space_direction * mat3(shadow.view_to_light); }

// Relative to the camera, of a lamp to its centre.
vec3 light_position(vec3 view_position) {
  if (is_lamp) view_position -= shadow.lamp.xyz;
  return mat3(shadow.view_to_light) * view_position;
}

vec3 view_position_of(Receiver receiver) {
  if (is_lamp) return receiver.from_lamp * mat3(shadow.view_to_light) + shadow.lamp.xyz;
  return receiver.position * mat3(shadow.view_to_light);
}

// How a receiver moves in light space if it moves by a little vector, which a lamp's face has in its own axes; metres.
vec3 along_rays(Receiver receiver, vec3 moves) {
  if (is_lamp) moves.xy -= receiver.position.xy * (moves.z / receiver.position.z);
  return moves;
}

// The same for a vector in view space.
vec3 move_in_light(Receiver receiver, vec3 view_vector) {
  vec3 moves = mat3(shadow.view_to_light) * view_vector;
  return along_rays(receiver, is_lamp ? seen_by_face(moves, receiver.layer) : moves);
}

// By how much its plane then moves along the light, metres.
float plane_moves(Receiver receiver, vec3 view_vector) {
  vec3 moves = move_in_light(receiver, view_vector);
  return abs(moves.z - dot(receiver.gradient, moves.xy));
}

// Width of a pixel at a position in view space, metres.
float pixel_width(vec3 position) {
  return max(shadow.pixel_size.x, shadow.pixel_size.y) * abs(shadow.pixel_size.z * position.z + shadow.pixel_size.w);
}

// How many pixels a metre on a plane through a position takes along x and along y; view space.
vec2 pixels_on_plane(vec3 position, vec3 normal) {
  vec2 size = abs(shadow.pixel_size.xy * (shadow.pixel_size.z * position.z + shadow.pixel_size.w));
  // The direction in which the point moves as depth changes.
  vec3 ray = shadow.clip_to_view[2].xyz - position * shadow.clip_to_view[2].w;
  return vec2(pixels_a_metre(vec3(size.x, 0.0, 0.0), ray, normal),
              pixels_a_metre(vec3(0.0, size.y, 0.0), ray, normal));
}

// Direction in which the camera sees a position in view space, or the opposite one.
vec3 view_ray(vec3 position) { return normalize(shadow.pixel_size.z * position + vec3(0.0, 0.0, shadow.pixel_size.w)); }

// A receiver's normal in view space, and in axes that are the same for all layers and constant while the light is.
vec3 view_normal_of(Receiver receiver) { return view_direction(is_lamp ? receiver.lamp_normal : receiver.normal); }
vec3 shared_normal_of(Receiver receiver) {
  if (is_lamp) return receiver.lamp_normal;
  vec2 turn = shadow.axes_turn, across = receiver.normal.xy;
  return vec3(turn.x * across.x - turn.y * across.y, turn.y * across.x + turn.x * across.y, receiver.normal.z);
}

// A lamp's receiver as one of its faces sees it.
Receiver seen_by_layer(Receiver receiver, int layer) {
  if (is_lamp) {
    receiver.layer = layer;
    receiver.position = seen_by_face(receiver.from_lamp, layer);
    receiver.normal = seen_by_face(receiver.lamp_normal, layer);
    receiver.gradient = lamp_plane_gradient(receiver.normal, receiver.position, max_plane_slope);
  }
  return receiver;
}

// A receiver from its position in view space and its normal in light space.
Receiver make_receiver(vec3 view_position, vec3 light_normal, vec2 pixel) {
  Receiver receiver;
  receiver.position = receiver.from_lamp = light_position(view_position);
  receiver.normal = receiver.lamp_normal = light_normal;
  receiver.layer = 0;
  if (is_lamp) {
    receiver = seen_by_layer(receiver, shadow.layer_count > 1 ? faces_of(receiver.from_lamp).x : 0);
  } else {
    receiver.gradient = plane_gradient(light_normal, max_plane_slope);
  }
  receiver.surroundings = Surroundings(vec4(0.0), 0.0, 0.0, 0.0);
  receiver.pixel = pixel;
  receiver.depth_error = 0.0;
  receiver.history_refused = false;
  return receiver;
}

// Cosine of the angle between the receiver's normal and the direction to the light.
float light_cosine(Receiver receiver) {
  if (is_lamp) return -dot(receiver.lamp_normal, receiver.from_lamp) / max(length(receiver.from_lamp), 1e-15);
  return -receiver.normal.z;
}

// Whether the light reaches the receiver if nothing blocks it: a spot shines only within its cone, a lamp within its
// range.
bool shines_at(Receiver receiver) {
  if (!is_lamp) return true;
  float away = length(receiver.from_lamp);
  return away <= shadow.lamp_range && receiver.from_lamp.z >= shadow.lamp.w * away;
}

// Penumbrae.

// Radius, metres, of the penumbra at a receiver whose blocker is at that distance from it along the light. It is also
// the radius of the disc outside of which a blocker at that distance blocks no light from the receiver.
float penumbra_radius(Receiver receiver, float blocker_distance, Light light) {
  return sun_penumbra_radius(light.extent, blocker_distance);
}

vec4 penumbra_radii(Receiver receiver, vec4 blocker_distances, Light light) {
  return light.extent * max(blocker_distances, 0.0);
}

// Slope (depth per metre) above which a surface that rises beside the receiver enters the cone from the receiver to the
// light.
float cone_slope(Receiver receiver, Light light) {
  float widest = is_lamp ? light.extent * (light.outline.x + light.outline.y - 1.0) : light.extent;
  return 1.0 / max(widest, 1.0 / max_plane_slope);
}

// Least difference between the stored depths of neighbouring texels of the light's layer, in a row and in a column,
// that makes an edge. Along a surface with smaller ones no texel can be in such a cone from a point of the surface,
// unless it borders the point. For frame_light(), of any kind.
vec2 stored_edge_heights(Light light) {
  const float diagonal = 0.5;  // texels along a diagonal lie further apart than their rows and columns
  // A slope of a lamp's space is that in metres divided by the depth.
  float deepest = is_lamp ? -1.0 / (shadow.widest.near_depth + shadow.widest.depth_range) : 1.0;
  float slope = 1.0 / max(light.extent * shadow.light_stretch, deepest / max_plane_slope);
  vec2 along = diagonal * (light.map.texel * light.map.texel_shares) * slope;
  return (along + 2.0 * light.map.rounding) / light.map.depth_range;
}

// Conversion between the blocker distance in a packed texel and the penumbra radius that filters need, for a receiver
// at that position in light space. The factor has a lower bound, so that also for a light without extent distances stay
// within the range of a half float.
const float least_packed_slope = 1e-4;

float packed_radius(vec3 position, float blocker_distance) {
  float radius = max(shadow.light_extent, least_packed_slope) * blocker_distance;
  // A lamp's blockers are nearer than the lamp.
  return is_lamp ? radius / max(length(position) - blocker_distance, 1e-3) : radius;
}

float packed_distance(vec3 position, float radius) {
  float extent = max(shadow.light_extent, least_packed_slope);
  return is_lamp ? length(position) * (radius / (radius + extent)) : radius / extent;
}

// The distance from a receiver to a blocker, metres, for a difference of their light-space depths.
float metres_to_blocker(Receiver receiver, float depth_difference) {
  if (!is_lamp) return depth_difference;
  float height = max(depth_difference, 0.0);
  return height / max(receiver.position.z + height, 1e-6) * length(receiver.from_lamp);
}

// The map.

// Light-space depth, metres, for a depth as stored in the map.
float stored_depth(float stored, LayerBlock map) { return map.near_depth + map.depth_range * stored; }
vec4 stored_depths(vec4 stored, LayerBlock map) { return map.near_depth + map.depth_range * stored; }
float stored_depth(float stored, Light light) { return stored_depth(stored, light.map); }

ivec2 last_texel() { return ivec2(shadow.map_size) - 1; }

// Depth as the light's layer stores it, for a depth in light space, metres; and the same for differences of depths.
float stored_of(float depth, Light light) { return (depth - light.map.near_depth) / light.map.depth_range; }
float stored_difference(float difference, Light light) { return difference / light.map.depth_range; }
float stored_metres(Light light) { return light.map.depth_range; }  // from 0 to 1

// Stored depth in a texel of the light's layer of a map; 1 outside of the map, where there are no casters.
float stored_in(sampler2DArray map, ivec2 texel, Light light) {
  ivec2 within = clamp(texel, ivec2(0), last_texel());
  float stored = texelFetch(map, ivec3(within, light.layer), 0).x;
  return within == texel ? stored : 1.0;
}

float stored_at(ivec2 texel, Light light) { return stored_in(shadow_depth, texel, light); }

// Width of a texel of the light's layer at a position's depth, metres, or its height where that is larger.
float texel_size_at(vec3 position, Light light) { return light.map.texel; }
float texel_size(Receiver receiver, Light light) { return texel_size_at(receiver.position, light); }

// Width and height of a texel, metres.
vec2 texel_extent_at(vec3 position, Light light) { return light.map.texel * light.map.texel_shares; }
vec2 texel_extent(Receiver receiver, Light light) { return texel_extent_at(receiver.position, light); }

// Slope of the receiver's plane in depth per width of a texel, over texel_size().
float texel_slope(Receiver receiver, Light light) { return length(receiver.gradient * light.map.texel_shares); }

// Upper bound of the error along the light that rounding in the map, in light space and in the receiver's depth causes,
// metres.
float depth_rounding(Receiver receiver, Light light) {
  float rounding = light.map.rounding + receiver.depth_error;
  return is_lamp ? rounding + 1e-6 * (length(shadow.lamp.xyz) + length(receiver.from_lamp)) : rounding;
}

// Map coordinates of a position in the light's layer, in texels; texel centres are at half-integers.
vec2 map_place(vec3 position, Light light) {
  return ((position.xy - light.map.center) * light.map.widths_per_metre + 0.5) * shadow.map_size;
}

// An offset in texels of the light's layer.
vec2 map_offset(vec2 offset, Light light) { return offset * (light.map.widths_per_metre * shadow.map_size); }

// Depth in a texel of the light's layer of a map, metres. Outside of the map there are no casters: it is the far
// plane's there, as where the sampler's border is read.
float depth_in(sampler2DArray map, ivec2 texel, Light light) {
  return stored_depth(stored_in(map, texel, light), light);
}

float depth_at(ivec2 texel, Light light) { return depth_in(shadow_depth, texel, light); }

// Offset of a texel's centre from the receiver.
vec2 texel_offset(Receiver receiver, ivec2 texel, Light light) {
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

// Stored depths of the four texels around map coordinates.
vec4 gather_stored(vec2 place, Light light) {
  return textureGather(shadow_depth, vec3(place * light.map.texel_uv, float(light.layer)));
}

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

Footprint fetch_footprint(Receiver receiver, vec2 offset, Light light) {
  vec2 at = texel_place(receiver, offset, light);
  vec2 first = floor(at);
  vec2 weight = at - first;
  return Footprint(stored_depths(gather_stored(first + 1.0, light), light.map),
                   footprint_offsets(receiver, offset, weight, light), weight);
}

// How much deeper than the receiver its plane lies at offsets, metres.
vec4 plane_depths(Receiver receiver, Offsets at) { return receiver.gradient.x * at.x + receiver.gradient.y * at.y; }

// The share of the four texels around a point that lie at or behind the receiver's plane less the bias, weighted
// bilinearly: one fetch of a sampler that compares and filters. It compares all four with one depth, the least of the
// plane at their centres: with a greater one, a lit plane would shadow itself.
float compared_share(sampler2DArrayShadow map, Receiver receiver, vec2 offset, float bias, Light light) {
  vec2 at = texel_place(receiver, offset, light);
  vec4 plane = plane_depths(receiver, footprint_offsets(receiver, offset, fract(at), light));
  float depth = receiver.position.z + min(min(plane.x, plane.y), min(plane.z, plane.w)) - bias;
  vec4 place = vec4((at + 0.5) * light.map.texel_uv, float(light.layer), min(stored_of(depth, light), 1.0));
  return textureGrad(map, place, vec2(0.0), vec2(0.0));  // there are no derivatives in compute shaders
}

// Layers.

// Largest distance of a disc's rim from the centre of a layer along either axis, in units of half the layer's width
// along it; above 1 the disc is not completely within the layer.
float layer_edge(int layer, vec3 position, float radius, Light light) {
  LayerBlock map = layer_map(layer, light);
  vec2 rim = abs(position.xy - map.center) + radius * outline_reach(light) + 1.5 * map.texel;
  vec2 inside = 2.0 * map.widths_per_metre * rim;
  return position.z - map.near_depth > map.depth_range * 1.0001 ? 2.0 : max(inside.x, inside.y);
}

// The finest layer that contains the whole disc, or the last layer if none does.
int finest_layer(Receiver receiver, float radius, Light light) {
  if (is_lamp) return receiver.layer;
  int layer = 0;
  while (layer < light.layers - 1 && layer_edge(layer, receiver.position, radius, light) > 1.0) ++layer;
  return layer;
}

struct LayerChoice {
  int layer;
  bool outside;  // no layer contains the position: it counts as lit
  int second;    // the layer to blend with
  float fade;    // 0 to 1: its weight
};

// How far beside an edge of a lamp's cube two faces are blended, as a share of a receiver's depth: no further than the
// map of the face beyond shows the receiver and the texels next to it.
float face_blend() {
  const float texels_beside = 3.0;
  LayerBlock map = shadow.layers[0];
  return min(cascades_blend, 1.0 - 1.0 / (0.5 / map.widths_per_metre.x - texels_beside * map.texel));
}

// A lamp's receiver reads the face that contains it. Beside an edge of the cube it also reads the face beyond, with a
// weight that grows to a half at the edge, and goes to 0 where a third face is as near.
LayerChoice choose_face(Receiver receiver, Light light) {
  vec3 away = abs(receiver.from_lamp);
  float most = max(away.x, max(away.y, away.z)), least = min(away.x, min(away.y, away.z));
  float middle = away.x + away.y + away.z - most - least;
  bool outside = receiver.position.z <= 0.0 || layer_edge(receiver.layer, receiver.position, 0.0, light) > 1.0;
  float fade = 0.0;
  if (cascades_seam != cascades_seam_none && light.layers > 1) {
    float width = face_blend() * most;
    fade = 0.5 * clamp((middle - most + width) / width, 0.0, 1.0) * clamp((middle - least) / width, 0.0, 1.0);
  }
  return LayerChoice(receiver.layer, outside, light.layers > 1 ? faces_of(receiver.from_lamp).y : 0, fade);
}

// Chooses the layer from which a receiver reads a disc.
LayerChoice choose_layer(Receiver receiver, float radius, Light light) {
  if (is_lamp) return choose_face(receiver, light);
  int layer = finest_layer(receiver, radius, light);
  bool last = layer == light.layers - 1;
  float fade = 0.0;
  if (cascades_seam != cascades_seam_none && !last) {
    fade = clamp((layer_edge(layer, receiver.position, radius, light) - 1.0) / cascades_blend + 1.0, 0.0, 1.0);
  }
  return LayerChoice(layer, last && layer_edge(layer, receiver.position, 0.0, light) > 1.0, layer + 1, fade);
}

// The light with the layer that contains every caster which can block light from a receiver, and the least depth that
// the light's layer can store.
Light with_widest_layer(Receiver receiver, Light light) {
  if (is_lamp) return with_layer(light, receiver.layer);
  light.layer = light.layers - 1;
  light.map = shadow.widest;
  return light;
}

float least_depth(Light light) { return light.map.near_depth; }

// Upper bound, metres, of the distance from a receiver to what moved since the last frame, along the light.
float most_moved_distance(Receiver receiver) {
  if (is_lamp) return receiver.position.z * (receiver.position.z / shadow.moved_depth - 1.0);
  return receiver.position.z - shadow.moved_depth;
}

// Pyramids over the light's layer of the map, whose level 0 has one texel for `base` texels of the map along each axis.

// The finest level of so many at which a rectangle of these half widths touches at most 2 × 2 texels.
int pyramid_level(vec3 position, vec2 radius, Light light, float base, int levels) {
  vec2 square = radius * outline_reach(light) / light.map.texel_shares;
  return covering_level(max(square.x, square.y), base * texel_size_at(position, light), levels);
}

int pyramid_level(vec3 position, float radius, Light light, float base, int levels) {
  return pyramid_level(position, vec2(radius), light, base, levels);
}

// The texels of a level that a rectangle of these half widths touches; `last` is the level's last texel.
struct TexelRange {
  ivec2 low, high;
};

TexelRange pyramid_range(vec3 position, vec2 radius, Light light, float base, int level, ivec2 last) {
  vec2 texel = base * texel_extent_at(position, light) * exp2(float(level));
  radius *= outline_reach(light);
  vec2 origin = position.xy - light.map.center + 0.5 / light.map.widths_per_metre;
  return TexelRange(clamp(ivec2(floor((origin - radius) / texel)), ivec2(0), last),
                    clamp(ivec2(floor((origin + radius) / texel)), ivec2(0), last));
}

// The two channels of 2 × 2 texels, at a level where a disc touches no more.
struct PyramidTexels {
  vec4 x, y;
};

PyramidTexels pyramid_texels(sampler2DArray pyramid, vec3 position, float radius, Light light, float base, int level,
                             ivec2 last) {
  TexelRange range = pyramid_range(position, vec2(radius), light, base, level, last);
  vec2 a = texelFetch(pyramid, ivec3(range.low, light.layer), level).xy;
  vec2 b = texelFetch(pyramid, ivec3(range.high.x, range.low.y, light.layer), level).xy;
  vec2 c = texelFetch(pyramid, ivec3(range.low.x, range.high.y, light.layer), level).xy;
  vec2 d = texelFetch(pyramid, ivec3(range.high, light.layer), level).xy;
  return PyramidTexels(vec4(a.x, b.x, c.x, d.x), vec4(a.y, b.y, c.y, d.y));
}
