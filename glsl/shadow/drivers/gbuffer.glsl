// Reads receivers from the caller's depth and normals, for a technique's own passes.
#include "shadow/light.glsl"
#include "lib/octahedral.glsl"

layout(binding = 2) uniform sampler2D receiver_depth;
layout(binding = 3) uniform sampler2D receiver_normal;

// Whether the pixel shows only sky.
bool is_sky(ivec2 pixel) { return texelFetch(receiver_depth, pixel, 0).x == shadow.sky_depth; }

float ndc_depth(float depth) { return depth * shadow.depth_to_ndc.x + shadow.depth_to_ndc.y; }

// View-space position (metres) of a point of the picture, pixels, with that stored depth.
vec3 unproject(vec2 at, float depth) {
  vec2 ndc = (at - shadow.viewport.xy) / shadow.viewport.zw * 2.0 - 1.0 - shadow.jitter.xy;
  vec4 view = shadow.clip_to_view * vec4(ndc, ndc_depth(depth), 1.0);
  return view.xyz / view.w;
}

// The most by which a view-space position, made from that stored depth, may be off along its view ray, metres.
vec3 position_error(vec3 position, float depth) {
  float error = shadow.depth_error.x + shadow.depth_error.y * abs(ndc_depth(depth));
  float clip_w = shadow.pixel_size.z * position.z + shadow.pixel_size.w;
  return error * clip_w * (shadow.clip_to_view[2].xyz - position * shadow.clip_to_view[2].w);
}

// View-space position (metres) of a pixel that is not sky.
vec3 view_position_at(ivec2 pixel) { return unproject(vec2(pixel) + 0.5, texelFetch(receiver_depth, pixel, 0).x); }

// The way to a neighbour on the receiver's surface, made from depths.
struct Neighbour {
  vec3 way;    // view space, metres
  float bend;  // by which stored depths leave a plane, over what rounding may do; a large number if it can't be used
};

const float no_neighbour = 1e30;

bool holds_receiver(ivec2 pixel) {
  vec2 at = vec2(pixel) - shadow.viewport.xy;
  return all(greaterThanEqual(at, vec2(0.0))) && all(lessThan(at, shadow.viewport.zw)) && !is_sky(pixel);
}

// Along a row or a column. Stored depths of a plane grow evenly from pixel to pixel, whatever the projection is.
Neighbour neighbour(ivec2 pixel, ivec2 next, vec3 at, float depth) {
  if (!holds_receiver(pixel + next)) return Neighbour(vec3(0.0), no_neighbour);
  float first = texelFetch(receiver_depth, pixel + next, 0).x;
  float second = holds_receiver(pixel + 2 * next) ? texelFetch(receiver_depth, pixel + 2 * next, 0).x : first;
  float error = (shadow.depth_error.x + shadow.depth_error.y * abs(ndc_depth(depth))) / shadow.depth_to_ndc.x;
  return Neighbour(unproject(vec2(pixel + next) + 0.5, first) - at, abs(2.0 * first - second - depth) / error);
}

// From the neighbour on one side to that on the other if both are on the receiver's plane, else on the side that is
// more even; over the picture's plane if there is none. View space, metres.
vec3 way_along(ivec2 pixel, ivec2 next, vec3 at, float depth) {
  const float even = 4.0;  // the roundings of three depths, one of them doubled
  Neighbour after = neighbour(pixel, next, at, depth), before = neighbour(pixel, -next, at, depth);
  if (max(after.bend, before.bend) <= even) return after.way - before.way;
  if (min(after.bend, before.bend) == no_neighbour) return unproject(vec2(pixel + next) + 0.5, depth) - at;
  return after.bend < before.bend ? after.way : -before.way;
}

// Where the caller brings no normals: that of the plane through the pixel and its neighbours, light space. `apart`:
// distances of the points that it was made from, metres.
vec3 normal_from_depth(ivec2 pixel, vec3 at, float depth, out vec2 apart) {
  vec3 right = way_along(pixel, ivec2(1, 0), at, depth), up = way_along(pixel, ivec2(0, 1), at, depth);
  vec3 normal = normalize(cross(right, up));
  apart = vec2(length(right), length(up));
  return direction_from_view(dot(normal, view_ray(at)) < 0.0 ? -normal : normal);
}

// Geometric normal of a pixel that is not sky, light space.
vec3 stored_normal_at(ivec2 pixel) {
  vec3 stored = texelFetch(receiver_normal, pixel, 0).xyz * shadow.normal_decode.x + shadow.normal_decode.y;
  vec3 normal = shadow.octahedral_normals != 0 ? octahedral_decode(stored.xy) : normalize(stored);
  return light_direction(normal);
}

vec3 light_normal_at(ivec2 pixel) {
  if (shadow.normals_from_depth == 0) return stored_normal_at(pixel);
  float depth = texelFetch(receiver_depth, pixel, 0).x;
  vec2 apart;
  return normal_from_depth(pixel, unproject(vec2(pixel) + 0.5, depth), depth, apart);
}

Receiver receiver_at(ivec2 pixel) {
  float depth = texelFetch(receiver_depth, pixel, 0).x;
  vec3 position = unproject(vec2(pixel) + 0.5, depth);
  vec2 apart;
  vec3 normal = shadow.normals_from_depth != 0 ? normal_from_depth(pixel, position, depth, apart)
                                               : stored_normal_at(pixel);
  Receiver receiver = make_receiver(position, normal, vec2(pixel));
  receiver.depth_error = plane_moves(receiver, position_error(position, depth));
  if (shadow.normals_from_depth != 0) {
    // Both ends may be off, and a metre across the light is more on a plane that is steep along it.
    float longer = sqrt(1.0 + dot(receiver.gradient, receiver.gradient));
    receiver.depth_tilt = 2.0 * receiver.depth_error * longer * (1.0 / apart.x + 1.0 / apart.y);
  }
  return receiver;
}
