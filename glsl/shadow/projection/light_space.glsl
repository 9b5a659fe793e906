// A receiver, the light as it sees it, and the way between their spaces and that of the view.
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
  float depth_error;  // the most by which its plane may be off along the light because of rounding, metres
  float depth_tilt;   // the most by which it may also be tilted, metres along the light per metre across
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

// A lamp's map as that of a sun, for receivers at this depth. Depths are differences of large numbers: if compilers
// rounded them in other ways, two programs could decide differently for one pixel.
LayerBlock map_at_depth(LayerBlock map, float depth) {
  precise float near_depth = depth * (2.0 + depth * map.near_depth), depth_range = map.depth_range * (depth * depth);
  map.widths_per_metre /= depth;
  map.texel *= depth;
  map.near_depth = near_depth;
  map.depth_range = depth_range;
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
vec3 world_direction(vec3 light_space_direction) { return light_space_direction * mat3(shadow.world_to_light); }
vec3 direction_from_view(vec3 view_vector) { return mat3(shadow.view_to_light) * view_vector; }
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

// How far a receiver's plane moves along the light, with sign, for each metre that the receiver moves along x, y and z
// of view space; metres.
vec3 plane_moves(Receiver receiver) {
  vec3 across = vec3(-receiver.gradient, 1.0);
  if (is_lamp) {
    across.z += dot(receiver.gradient, receiver.position.xy) / receiver.position.z;
    across = from_face(across, receiver.layer);
  }
  return across * mat3(shadow.view_to_light);
}

// Width of a pixel at a position in view space, metres.
float pixel_width(vec3 position) {
  vec2 size = abs(shadow.pixel_size.xy);  // either is negative in a picture that is turned over
  return max(size.x, size.y) * abs(shadow.pixel_size.z * position.z + shadow.pixel_size.w);
}

// Rasterisers round vertices to a grid, so what they draw at a pixel's centre may be a point of the surface up to half
// a step of the grid beside it. Returns that distance along x and y of view space, metres.
vec2 rounding_of_vertices(vec3 position) {
  float clip_w = shadow.pixel_size.z * position.z + shadow.pixel_size.w;
  return abs(shadow.vertex_rounding * clip_w * shadow.pixel_size.xy);
}

// The most by which a receiver's plane may be off along the light for that reason, metres. `moves`: plane_moves().
float vertex_error(vec3 moves, vec3 position) { return dot(abs(moves.xy), rounding_of_vertices(position)); }

// How many pixels a metre on a plane through a position takes along x and along y; view space.
vec2 pixels_on_plane(vec3 position, vec3 normal) {
  vec2 size = abs(shadow.pixel_size.xy * (shadow.pixel_size.z * position.z + shadow.pixel_size.w));
  // The direction in which the point moves as depth changes.
  vec3 ray = shadow.clip_to_view[2].xyz - position * shadow.clip_to_view[2].w;
  return vec2(pixels_a_metre(vec3(size.x, 0.0, 0.0), ray, normal),
              pixels_a_metre(vec3(0.0, size.y, 0.0), ray, normal));
}

// The most that pixels_on_plane() can be for any plane through the position.
vec2 most_pixels_on_plane(vec3 position) {
  vec2 size = abs(shadow.pixel_size.xy * (shadow.pixel_size.z * position.z + shadow.pixel_size.w));
  vec3 ray = shadow.clip_to_view[2].xyz - position * shadow.clip_to_view[2].w;
  // Where the rays of two neighbouring pixels meet a plane, they are at least as far apart as the rays are.
  return inversesqrt(max(1.0 - ray.xy * ray.xy / dot(ray, ray), 1e-6)) / size;
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
  receiver.depth_error = receiver.depth_tilt = 0.0;
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
