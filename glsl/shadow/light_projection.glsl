// The only file that knows what kind of light there is and how its shadow map is projected: where a position lies in
// the map, what depth in metres a stored one means, how wide a texel is, and how wide a penumbra. There is one kind: a
// sun, with parallel rays and orthographic cascades as layers. All else works in light space:
//   - z is the depth along the light, metres, growing away from it; it is what the map stores. x and y lie across it.
//   - Offsets and radii are metres across the light at the receiver's depth, whatever the projection makes of them.
//   - A light's shadow map has layers, of which a receiver reads one, or two where they overlap and fade.
#include "shared/shadow_block.h"
#include "lib/kernel.glsl"

layout(std140, binding = 1) uniform ShadowData { ShadowBlock shadow; };

layout(binding = 0) uniform sampler2DArray shadow_depth;  // as stored, one layer a layer of the light

// A point to be shaded, in light space.
struct Receiver {
  vec3 position;
  vec3 normal;    // geometric
  vec2 gradient;  // of its plane: change of depth per metre across the light
  Surroundings surroundings;
  vec2 pixel;     // seeds the noise
  bool history_refused;  // there is a history, and it does not hold here: more taps are worth it
};

struct Light {
  float extent;  // of a sun: the tangent of half the angle that it spans
  bool square;   // else a disc
  int layers;
  int layer;          // the one to read
  float read_radius;  // metres: what the technique said that it reads
};

const float max_plane_slope = 1000.0;

Light frame_light() {
  return Light(shadow.light_extent, shadow.light_is_square != 0, shadow.layer_count, 0, 0.0);
}

// Light space and back. Directions of light space are unit where those of the world are.

vec3 light_direction(vec3 world_direction) { return mat3(shadow.world_to_light) * world_direction; }
vec3 view_direction(vec3 light_space_direction) { return light_space_direction * mat3(shadow.view_to_light); }

vec3 light_position(vec3 view_position) { return mat3(shadow.view_to_light) * view_position; }
vec3 view_position_of(Receiver receiver) { return receiver.position * mat3(shadow.view_to_light); }

// A receiver's normal in view space, and in axes that all layers share and that stay while the light does.
vec3 view_normal_of(Receiver receiver) { return view_direction(receiver.normal); }
vec3 shared_normal_of(Receiver receiver) { return receiver.normal; }

// A receiver from its position in view space and its normal in light space.
Receiver make_receiver(vec3 view_position, vec3 light_normal, vec2 pixel) {
  Receiver receiver;
  receiver.position = light_position(view_position);
  receiver.normal = light_normal;
  receiver.gradient = plane_gradient(light_normal, max_plane_slope);
  receiver.surroundings = Surroundings(vec4(0.0), 0.0, 0.0, 0.0);
  receiver.pixel = pixel;
  receiver.history_refused = false;
  return receiver;
}

// Cosine of the angle between the receiver's normal and the direction to the light.
float light_cosine(Receiver receiver) { return -receiver.normal.z; }

// Penumbrae.

// Radius, metres, of the penumbra at a receiver of a blocker that lies so far before it along the light. So it is also
// that of the disc outside of which such a blocker hides nothing of the light.
float penumbra_radius(Receiver receiver, float blocker_distance, Light light) {
  return sun_penumbra_radius(light.extent, blocker_distance);
}

vec4 penumbra_radii(Receiver receiver, vec4 blocker_distances, Light light) {
  return light.extent * max(blocker_distances, 0.0);
}

// Slope against the light above which a surface beside the receiver lies within the cone that the light spans there.
float cone_slope(Receiver receiver, Light light) { return 1.0 / max(light.extent, 1.0 / max_plane_slope); }

// A packed texel holds a blocker distance, and filters need the penumbra's radius: from one to the other and back, for
// a receiver at that position in light space. For a light without extent the slope between them is not 0, so that
// distances stay within the range of a half float.
const float least_packed_slope = 1e-4;

float packed_radius(vec3 position, float blocker_distance) {
  return max(shadow.light_extent, least_packed_slope) * blocker_distance;
}

float packed_distance(vec3 position, float radius) { return radius / max(shadow.light_extent, least_packed_slope); }

// The map.

// Light-space depth of a stored one, metres.
float stored_depth(float stored, int layer) {
  return shadow.layers[layer].near_depth + shadow.layers[layer].depth_range * stored;
}
vec4 stored_depths(vec4 stored, int layer) {
  return shadow.layers[layer].near_depth + shadow.layers[layer].depth_range * stored;
}

// Width of a layer's texel at a position's depth, metres.
float texel_size_at(vec3 position, int layer) { return shadow.layers[layer].texel; }
float texel_size(Receiver receiver, Light light) { return texel_size_at(receiver.position, light.layer); }

// What rounding in the map and in light space can be off by along the light, metres.
float depth_rounding(Light light) { return shadow.layers[light.layer].rounding; }

// Where a position lies in a layer's map, texels: a texel's centre is at half.
vec2 map_place(vec3 position, int layer) {
  LayerBlock map = shadow.layers[layer];
  return ((position.xy - map.center) * map.widths_per_metre + 0.5) * shadow.map_size;
}

ivec2 last_texel() { return ivec2(shadow.map_size) - 1; }

// Depth that a texel of the light's layer holds, metres; beyond the map that of its rim.
float depth_at(ivec2 texel, Light light) {
  ivec2 within = clamp(texel, ivec2(0), last_texel());
  return stored_depth(texelFetch(shadow_depth, ivec3(within, light.layer), 0).x, light.layer);
}

// Offset of a texel's centre from the receiver.
vec2 texel_offset(Receiver receiver, ivec2 texel, Light light) {
  LayerBlock map = shadow.layers[light.layer];
  vec2 center = (vec2(texel) + 0.5) * map.texel - 0.5 / map.widths_per_metre + map.center;
  return center - receiver.position.xy;
}

// Offsets of four texels' centres from the receiver.
struct Offsets {
  vec4 x, y;
};

// Four texels about a point of the map, in the order of textureGather: (0,1) (1,1) (1,0) (0,0).
struct Footprint {
  vec4 depths;  // metres
  Offsets offsets;
  vec2 weight;  // bilinear, of the texels with the higher coordinate
};

// As stored, of the four texels about a place of the map.
vec4 gather_stored(vec2 place, int layer) {
  return textureGather(shadow_depth, vec3(place / shadow.map_size, float(layer)));
}

Footprint fetch_footprint(Receiver receiver, vec2 offset, Light light) {
  vec2 at = map_place(vec3(receiver.position.xy + offset, receiver.position.z), light.layer) - 0.5;
  vec2 first = floor(at);
  float texel = texel_size(receiver, light);
  Footprint footprint;
  footprint.depths = stored_depths(gather_stored(first + 1.0, light.layer), light.layer);
  footprint.weight = at - first;
  vec2 low = offset - footprint.weight * texel;
  vec2 high = low + texel;
  footprint.offsets = Offsets(vec4(low.x, high.x, high.x, low.x), vec4(high.y, high.y, low.y, low.y));
  return footprint;
}

// How much deeper than the receiver its plane lies at offsets, metres.
vec4 plane_depths(Receiver receiver, Offsets at) { return receiver.gradient.x * at.x + receiver.gradient.y * at.y; }

// Layers.

// Largest distance of a disc's rim from the middle of a layer's map along either axis, in half widths; over 1 it is not
// within the map.
float layer_edge(int layer, vec3 position, float radius) {
  LayerBlock map = shadow.layers[layer];
  vec2 d = abs(position.xy - map.center);
  float inside = 2.0 * map.widths_per_metre * (max(d.x, d.y) + radius + 1.5 * map.texel);
  return position.z - map.near_depth > map.depth_range * 1.0001 ? 2.0 : inside;
}

// The finest layer that holds the whole disc; the last one holds what no other does.
int finest_layer(Receiver receiver, float radius, Light light) {
  int layer = 0;
  while (layer < light.layers - 1 && layer_edge(layer, receiver.position, radius) > 1.0) ++layer;
  return layer;
}

struct LayerChoice {
  int layer;
  bool outside;  // no layer holds the position: the light is not hidden there
  float fade;    // 0 to 1: weight of the next layer beside this one
};

// Which layer a receiver reads a disc from.
LayerChoice choose_layer(Receiver receiver, float radius, Light light) {
  int layer = finest_layer(receiver, radius, light);
  bool last = layer == light.layers - 1;
  float fade = 0.0;
  if (cascades_seam != cascades_seam_none && !last) {
    fade = clamp((layer_edge(layer, receiver.position, radius) - 1.0) / cascades_blend + 1.0, 0.0, 1.0);
  }
  return LayerChoice(layer, last && layer_edge(layer, receiver.position, 0.0) > 1.0, fade);
}

// The layer that sees every caster which can hide the light from a receiver, and the least depth that it can hold.
int widest_layer(Receiver receiver, Light light) { return light.layers - 1; }
float least_depth(int layer) { return shadow.layers[layer].near_depth; }

// Pyramids over the map, whose level 0 has one texel for `base` texels of the map along each axis.

// The finest level of so many at which a disc touches at most 2 × 2 texels.
int pyramid_level(vec3 position, float radius, int layer, float base, int levels) {
  return covering_level(radius, base * texel_size_at(position, layer), levels);
}

// What those 2 × 2 texels hold, of which `last` is the last of the level.
vec4 pyramid_texels(sampler2DArray pyramid, vec3 position, float radius, int layer, float base, int level, ivec2 last) {
  LayerBlock map = shadow.layers[layer];
  float texel = base * map.texel * exp2(float(level));
  vec2 origin = position.xy - map.center + 0.5 / map.widths_per_metre;
  ivec2 low = clamp(ivec2(floor((origin - radius) / texel)), ivec2(0), last);
  ivec2 high = clamp(ivec2(floor((origin + radius) / texel)), ivec2(0), last);
  return vec4(texelFetch(pyramid, ivec3(low, layer), level).x,
              texelFetch(pyramid, ivec3(high.x, low.y, layer), level).x,
              texelFetch(pyramid, ivec3(low.x, high.y, layer), level).x,
              texelFetch(pyramid, ivec3(high, layer), level).x);
}
