// How wide the light is, and what that makes of distances to blockers.
#include "shadow/projection/light_space.glsl"

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

// Whether the light is so narrow that the bound counts. Then distances that are computed from radii are wrong, and
// radii that are computed from distances too large, by up to 1e-4 of these.
bool is_light_narrow() { return shadow.light_extent < least_packed_slope; }

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
