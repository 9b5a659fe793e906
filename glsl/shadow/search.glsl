// Bounds for the blocker search: the least depth over a disc, read from the pyramid; and what is drawn where they leave
// less than a texel.
#include "shadow/light.glsl"

// Least depths over 4 · 2^level texels squared: the product of that name.
layout(binding = UNIT_least_depth_pyramid) uniform sampler2DArray shadow_pyramid;

const float pyramid_base = 4.0;

// Least depths, metres, of what the light's layer of the map holds within a disc.
struct DepthBounds {
  float least;
  float edge;  // beside an edge of the map
};

// The least of both values of a pyramid of this kind over a rectangle of these half widths and a little beyond, in the
// texels of a level.
vec2 least_in_rectangle(sampler2DArray pyramid, vec3 position, vec2 radius, int level, Light light) {
  ivec2 last = max(last_texel(), 0) >> (level + 2);
  TexelRange range = pyramid_range(position, radius, light, pyramid_base, level, last);
  vec2 stored = vec2(1.0);
  ivec2 at = range.low;
  do {
    stored = min(stored, texelFetch(pyramid, ivec3(at, light.layer), level).xy);
    at = next_texel(at, range);
  } while (at.y <= range.high.y);
  return stored;
}

// The same in at most 5 × 5 texels.
vec2 least_in_rectangle(sampler2DArray pyramid, vec3 position, vec2 radius, Light light) {
  int level = pyramid_level(position, 0.25 * radius, light, pyramid_base, textureQueryLevels(pyramid));
  return least_in_rectangle(pyramid, position, radius, level, light);
}

DepthBounds rectangle_bounds(vec3 position, vec2 radius, int level, Light light) {
  vec2 stored = least_in_rectangle(shadow_pyramid, position, radius, level, light);
  return DepthBounds(stored_depth(stored.x, light), stored_depth(stored.y, light));
}

DepthBounds depth_bounds(vec3 position, vec2 radius, Light light) {
  vec2 stored = least_in_rectangle(shadow_pyramid, position, radius, light);
  return DepthBounds(stored_depth(stored.x, light), stored_depth(stored.y, light));
}

// The finest level at which a disc touches at most 2 × 2 texels.
int disc_level(vec3 position, float radius, Light light) {
  return pyramid_level(position, radius, light, pyramid_base, textureQueryLevels(shadow_pyramid));
}

// Bounds over the texels of such a level that a disc touches.
DepthBounds level_bounds(vec3 position, float radius, int level, Light light) {
  ivec2 last = max(last_texel(), 0) >> (level + 2);
  PyramidTexels stored = pyramid_texels(shadow_pyramid, position, radius, light, pyramid_base, level, last);
  return DepthBounds(stored_depth(min(min(stored.x.x, stored.x.y), min(stored.x.z, stored.x.w)), light),
                     stored_depth(min(min(stored.y.x, stored.y.y), min(stored.y.z, stored.y.w)), light));
}

// Bounds within a disc and a little beyond.
DepthBounds bounds_near(vec3 position, float radius, Light light) {
  return level_bounds(position, radius, disc_level(position, radius, light), light);
}

// Bounds on where blockers can be.
struct Search {
  float radius;   // of the disc that contains every caster which can block a part of the light, metres
  float nearest;  // least depth in it, metres
};

// One refinement step in the light's layer: all casters lie within a disc of `limit` metres; their least depth bounds
// the blocker distance, which bounds the radius.
Search narrow_search(Receiver receiver, Light light, float limit) {
  float footprint = 1.5 * texel_size(receiver, light);
  float nearest = bounds_near(receiver.position, limit + footprint, light).least;
  float radius = penumbra_radius(receiver, receiver.position.z - nearest, light);
  return Search(min(limit, radius), nearest);
}

// The first step: the widest layer contains every caster, and none is nearer to the light than its near plane.
float search_radius(Receiver receiver, Light light) {
  light = with_widest_layer(receiver, light);
  float all = penumbra_radius(receiver, receiver.position.z - least_depth(light), light);
  return narrow_search(receiver, light, all).radius;
}

// Radius, metres, of the disc outside of which the map has no edge that can block a part of the light: a surface that
// blocks at the disc's rim blocks beyond it too. 0 where there is no such edge at all.
float edge_radius(Receiver receiver, Light light) {
  float radius = light.read_radius;
  for (int i = 0; i < 2; ++i) {
    float edge = bounds_near(receiver.position, radius + 1.5 * texel_size(receiver, light), light).edge;
    radius = min(radius, penumbra_radius(receiver, receiver.position.z - edge, light));
  }
  return radius;
}

// For techniques that spread their reads over the whole disc, so that a disc that is too wide leaves gaps between them:
// the same radii from bounds over finer texels of the pyramid. A large texel also holds high casters that are far from
// the disc.

// Radius, metres, of the disc that contains what blocks light from a receiver, if nothing in a disc of radius `limit`
// is nearer to the light than that depth.
float narrowed_radius(Receiver receiver, float limit, float least, Light light) {
  return min(limit, penumbra_radius(receiver, receiver.position.z - least, light));
}

float fine_search_radius(Receiver receiver, Light light) {
  float radius = search_radius(receiver, light);
  if (radius == 0.0) return 0.0;
  Light widest = with_widest_layer(receiver, light);
  float with_margin = radius + 1.5 * texel_size(receiver, widest);
  float nearest = depth_bounds(receiver.position, vec2(with_margin), widest).least;
  return narrowed_radius(receiver, radius, nearest, widest);
}

// The read radius, or up to `most` metres the radius of search_radius(): the widest layer may lack a caster that is
// narrower than its texels, and finer bounds over that layer miss it, too.
float radius_with_thin_casters(Receiver receiver, float most, Light light) {
  if (light.read_radius >= most) return light.read_radius;
  return max(light.read_radius, min(search_radius(receiver, light), most));
}

// edge_radius(), from that radius, in up to three steps, of which the last two follow where it is above `wide` metres:
// bounds over at most 3 × 3 texels of a level, and then over at most 5 × 5.
float fine_edge_radius(Receiver receiver, float radius, float wide, Light light) {
  int i = 0;
  do {
    float with_margin = radius + 1.5 * texel_size(receiver, light);
    int level = disc_level(receiver.position, (i == 0 ? 0.5 : 0.25) * with_margin, light);
    float edge = rectangle_bounds(receiver.position, vec2(with_margin), level, light).edge;
    radius = narrowed_radius(receiver, radius, edge, light);
  } while (++i < 3 && radius > wide);
  return radius;
}

// The shadow of the light's centre, filtered over the map's texel.
Visibility centre_shadow(Receiver receiver, float bias, Light light) {
  Footprint footprint = fetch_footprint(receiver, vec2(0.0), light);
  vec4 blocks = blocking_texels(receiver, footprint, bias);
  float covered = bilinear(blocks, footprint.weight);
  if (covered == 0.0) return fully_lit();
  float height_sum = bilinear(blocks * (receiver.position.z - footprint.depths), footprint.weight);
  float mean = max(height_sum / covered, 0.0);
  float penumbra = penumbra_radius(receiver, mean, light);
  return Visibility(1.0 - covered, penumbra, mean, penumbra < texel_size(receiver, light), false);
}

// The light with a read radius that also holds what covers a receiver's centre. A caster that is narrower than a texel
// of the widest layer may be missing from it, and so from the technique's read radius.
Light reading_centre(Visibility centre, Light light) {
  light.read_radius = max(light.read_radius, centre.penumbra_radius);
  return light;
}
