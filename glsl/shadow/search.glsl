// Bounds for the blocker search: the least depth over a disc, read from the pyramid.
#include "shadow/light.glsl"

// Minimum over 4 · 2^level texels squared: the product of that name.
layout(binding = UNIT_least_depth_pyramid) uniform sampler2DArray shadow_pyramid;

// Least depth, metres, of what a layer of the map holds within `radius` of a position (and a little beyond: 2 × 2
// texels of the finest level that covers the disc).
float nearest_depth(vec3 position, float radius, int layer) {
  const float base = 4.0;
  int level = pyramid_level(position, radius, layer, base, textureQueryLevels(shadow_pyramid));
  ivec2 last = max(last_texel(), 0) >> (level + 2);
  vec4 stored = pyramid_texels(shadow_pyramid, position, radius, layer, base, level, last);
  return stored_depth_in(layer, min(min(stored.x, stored.y), min(stored.z, stored.w)));
}

// Bounds on where blockers can be.
struct Search {
  float radius;   // of the disc that contains every caster which can block a part of the light, metres
  float nearest;  // least depth in it, metres
};

// One refinement step: all casters lie within a disc of `limit` metres; their least depth bounds the blocker distance,
// which bounds the radius.
Search narrow_search(Receiver receiver, Light light, int layer, float limit) {
  float footprint = 1.5 * texel_size_at(receiver.position, layer);
  float nearest = nearest_depth(receiver.position, limit + footprint, layer);
  float radius = penumbra_radius(receiver, receiver.position.z - nearest, light);
  return Search(min(limit, radius), nearest);
}

// The first step: the widest layer contains every caster, and none is nearer to the light than its near plane.
float search_radius(Receiver receiver, Light light) {
  int widest = widest_layer(receiver, light);
  float all = penumbra_radius(receiver, receiver.position.z - least_depth(widest), light);
  return narrow_search(receiver, light, widest, all).radius;
}
