// Normals for callers that bring none: of the plane through each pixel and its neighbours, from their depths. With
// GUIDED the caller brings normals of shading, which say which neighbours belong to a pixel's surface.
#include "shadow/drivers/gbuffer.glsl"

layout(location = 0) out vec4 stored;  // see StoredNormal

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
  error += shadow.vertex_rounding * abs(first - depth);
  return Neighbour(unproject(vec2(pixel + next) + 0.5, first) - at, abs(2.0 * first - second - depth) / error);
}

#if GUIDED
uniform vec2 decode;      // scale and offset to -1..1
uniform bool octahedral;  // else xyz

// The caller's normal, view space.
vec3 shading_normal_at(ivec2 pixel) {
  vec3 stored = texelFetch(receiver_normal, pixel, 0).xyz * decode.x + decode.y;
  vec3 normal = normalize(octahedral ? octahedral_direction(stored.xy) : stored);
  return view_direction(light_direction(normal));
}

// How steeply a way leaves the plane across the shading normal: the sine of the angle.
float steepness(Neighbour to, vec3 normal) {
  return to.bend == no_neighbour ? no_neighbour : abs(dot(normalize(to.way), normal));
}

// To the next pixel, on the plane across the shading normal.
vec3 way_across(ivec2 pixel, ivec2 next, vec3 at, float depth, vec3 normal) {
  vec3 beside = unproject(vec2(pixel + next) + 0.5, depth), ray = view_ray(beside);
  float along = dot(normal, ray);
  return beside - at + ray * (abs(along) > 1e-3 ? dot(normal, at - beside) / along : 0.0);
}
#endif

// From the neighbour on one side to that on the other if both are on the receiver's plane, else on the side that is
// more even, or nearer to the plane across the shading normal; over the picture's plane if there is none. View space,
// metres.
vec3 way_along(ivec2 pixel, ivec2 next, vec3 at, float depth) {
  const float even = 4.0;  // the roundings of three depths, one of them doubled
  Neighbour after = neighbour(pixel, next, at, depth), before = neighbour(pixel, -next, at, depth);
  if (max(after.bend, before.bend) <= even) return after.way - before.way;
#if GUIDED
  const float steepest = 0.87;  // of facets: 60 degrees from their shading normals
  vec3 normal = shading_normal_at(pixel);
  float to_after = steepness(after, normal), to_before = steepness(before, normal);
  if (min(to_after, to_before) > steepest) return way_across(pixel, next, at, depth, normal);
  if (min(after.bend, before.bend) > even) return to_after < to_before ? after.way : -before.way;
#else
  if (min(after.bend, before.bend) == no_neighbour) return unproject(vec2(pixel + next) + 0.5, depth) - at;
#endif
  return after.bend < before.bend ? after.way : -before.way;
}

// Of the plane through the pixel and its neighbours, view space. `apart`: distances of the points that it was made
// from, metres.
vec3 normal_from_depth(ivec2 pixel, vec3 at, float depth, out vec2 apart) {
  vec3 right = way_along(pixel, ivec2(1, 0), at, depth), up = way_along(pixel, ivec2(0, 1), at, depth);
  vec3 normal = normalize(cross(right, up));
  apart = vec2(length(right), length(up));
  return dot(normal, view_ray(at)) < 0.0 ? -normal : normal;
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  if (is_sky(pixel)) discard;
  float depth = texelFetch(receiver_depth, pixel, 0).x;
  vec2 apart;
  vec3 normal = normal_from_depth(pixel, unproject(vec2(pixel) + 0.5, depth), depth, apart);
  stored = vec4(octahedral_encode(world_direction(direction_from_view(normal))), apart);
}
