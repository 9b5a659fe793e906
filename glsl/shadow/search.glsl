// How far blockers can be: the least depth over a disc, from the pyramid.
#include "shadow/light.glsl"

// Least depth, metres, of what the cascade's map holds within `radius` of a position (and a little beyond: 2 × 2 texels
// of the finest level that covers the disc).
float nearest_depth(vec3 position, float radius, int cascade_index) {
  CascadeBlock cascade = shadow.cascades[cascade_index];
  int levels = textureQueryLevels(shadow_pyramid);
  int level = covering_level(radius, 4.0 * cascade.map.w, levels);
  float texel = 4.0 * cascade.map.w * exp2(float(level));
  ivec2 last = max(ivec2(shadow.light.w) - 1, 0) >> (level + 2);
  vec2 origin = position.xy - cascade.map.xy + 0.5 / cascade.map.z;
  ivec2 low = clamp(ivec2(floor((origin - radius) / texel)), ivec2(0), last);
  ivec2 high = clamp(ivec2(floor((origin + radius) / texel)), ivec2(0), last);
  float a = texelFetch(shadow_pyramid, ivec3(low, cascade_index), level).x;
  float b = texelFetch(shadow_pyramid, ivec3(high.x, low.y, cascade_index), level).x;
  float c = texelFetch(shadow_pyramid, ivec3(low.x, high.y, cascade_index), level).x;
  float d = texelFetch(shadow_pyramid, ivec3(high, cascade_index), level).x;
  return cascade.depth.x + cascade.depth.y * min(min(a, b), min(c, d));
}

// Where blockers can be.
struct Search {
  float radius;   // of the disc that holds every caster which can hide a part of the light, metres
  float nearest;  // least depth in it, metres
};

// One step: all casters lie within `reach` metres; those that do bound the depth, and the depth bounds the radius.
Search narrow_search(Receiver receiver, Light light, int cascade, float reach) {
  float footprint = 1.5 * shadow.cascades[cascade].map.w;
  float nearest = nearest_depth(receiver.position, reach + footprint, cascade);
  float radius = penumbra_radius(light.tan_half_angle, receiver.position.z, nearest);
  return Search(min(reach, radius), nearest);
}

// The first step: the coarsest cascade sees every caster, and none is nearer to the light than its map begins.
float search_reach(Receiver receiver, Light light) {
  int coarsest = light.cascades - 1;
  float all = penumbra_radius(light.tan_half_angle, receiver.position.z, shadow.cascades[coarsest].depth.x);
  return narrow_search(receiver, light, coarsest, all).radius;
}
