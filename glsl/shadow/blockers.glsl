// The steps of percentage-closer soft shadows (Fernando 2005): mean blocker depth, kernel size, filter. For techniques
// that need the "least_depth_pyramid" and have the sample sets "blocker", "filter" and "disocclusion", and that define
//   const bool blocker_footprints  whether the blocker search reads the four texels around each point, else one
// It is no parameter of the functions: drivers would inline both ways before they drop one.
#ifndef HISTORY
#define HISTORY 0  // 1: receivers may say that their history is refused
#endif
#include "shadow/search.glsl"
#include "shadow/sampling.glsl"

struct Blockers {
  float depth_sum;  // metres, relative to the receiver
  float weight;     // fraction of the texels read that are blockers
};

// A texel nearer to the receiver than this, metres, may cover it even if the texel's centre lies outside of the light's
// cone.
float footprint_margin(Receiver receiver, Light light) { return 1.5 * texel_size(receiver, light); }

// Which texels lie within the cone from the receiver to the light: what is outside of it can't block the light, however
// wide the search disc is.
vec4 in_light_cone(Receiver receiver, Offsets at, vec4 blocker_distances, Light light) {
  vec4 radii = penumbra_radii(receiver, blocker_distances, light) + footprint_margin(receiver, light);
  Outline place = from_outline(at.x, at.y, light);
  return within_cone(radii, is_square(light), place.x, place.y);
}

// A texel is a blocker if it is nearer to the light than the receiver and its plane, and within the light's cone.

// Adds the texel at a point.
void add_blocker(inout Blockers blockers, Receiver receiver, vec2 offset, float bias, Light light) {
  PointTexel texel = fetch_texel(receiver, offset, light);
  float distance_to = receiver.position.z - texel.depth;
  Offsets at = Offsets(vec4(texel.offset.x), vec4(texel.offset.y));
  float inside = in_light_cone(receiver, at, vec4(distance_to), light).x;
  float blocks = texel.depth < blocking_depths_at(receiver, at, bias).x ? inside : 0.0;
  blockers.weight += blocks;
  blockers.depth_sum += blocks * distance_to;
}

// Adds the four texels around a point, by bilinear weights.
void add_blockers(inout Blockers blockers, Receiver receiver, vec2 offset, float bias, Light light) {
  Footprint footprint = fetch_footprint(receiver, offset, light);
  vec4 distance_to = receiver.position.z - footprint.depths;
  vec4 inside = in_light_cone(receiver, footprint.offsets, distance_to, light);
  vec4 blocks = inside * blocking_texels(receiver, footprint, bias);
  blockers.weight += bilinear(blocks, footprint.weight);
  blockers.depth_sum += bilinear(blocks * distance_to, footprint.weight);
}

// The mean over the points of the set, each with its texel or with the four texels around it. Where the disc is smaller
// than the four texels around the receiver, or no point finds a blocker, these four are read instead: near the receiver
// the cone is narrow, so that all taps of a wide disc can miss a blocker that touches it.
Blockers find_blockers(Receiver receiver, float radius, int taps, float bias, Light light) {
  Scramble scramble = blocker_scramble(receiver);
  Blockers blockers = Blockers(0.0, 0.0);
  int count = radius < 0.5 * texel_size(receiver, light) ? 0 : taps;
  int i = 0;
  do {
    bool at_receiver = i == count;
    vec2 offset = at_receiver ? vec2(0.0) : radius * blocker_point(i, scramble, light);
    if (blocker_footprints) {
      add_blockers(blockers, receiver, offset, bias, light);
    } else if (!at_receiver) {
      add_blocker(blockers, receiver, offset, bias, light);
    }
  } while (++i < count || (blocker_footprints && i == count && blockers.weight == 0.0));
  if (!blocker_footprints && blockers.weight == 0.0) add_blockers(blockers, receiver, vec2(0.0), bias, light);
  return blockers;
}

float mean_distance(Blockers blockers) { return max(blockers.depth_sum / blockers.weight, 0.0); }

// The filter's sample points: their number, and whether they come from the set "disocclusion" for rejected histories.
struct FilterPoints {
  int count;
  bool disocclusion;
};

vec2 point_of(FilterPoints points, int index, Scramble scramble, Light light) {
  return points.disocclusion ? disocclusion_point(index, scramble, light) : filter_point(index, scramble, light);
}

// Visibility averaged over a disc (or square) of that radius around the receiver.
float filtered_share(Receiver receiver, float radius, FilterPoints points, float bias, Light light) {
  Scramble scramble = filter_scramble(receiver);
  float lit = 0.0;
  int i = 0;
  do {
    lit += lit_share(receiver, radius * point_of(points, i, scramble, light), bias, light);
  } while (++i < points.count);
  return lit / float(points.count);
}

// The second step: penumbra radius from the mean blocker distance, then the filter.
Visibility filtered(Receiver receiver, float mean, FilterPoints points, float bias, Light light) {
  float radius = penumbra_radius(receiver, mean, light);
  return Visibility(filtered_share(receiver, radius, points, bias, light), radius, mean,
                    radius < texel_size(receiver, light), false);
}

// Both steps with the given numbers of taps, and with another number where the history is rejected. With early exit,
// both are skipped where the depth bounds rule out blockers.
Visibility soft_shadow(Receiver receiver, Light light, int blocker_taps, int filter_taps, int disocclusion_taps,
                       bool early_exits) {
  float bias = depth_bias(receiver, light);
  Search search = narrow_search(receiver, light, light.read_radius);
  if (early_exits && search.nearest >= receiver.position.z - bias) return fully_lit();
  receiver = with_surroundings(receiver, bias, cone_slope(receiver, light), light);
  Blockers blockers = find_blockers(receiver, search.radius, blocker_taps, bias, light);
  if (blockers.weight == 0.0) return fully_lit();
  float mean = mean_distance(blockers);
#if HISTORY
  if (receiver.history_refused) return filtered(receiver, mean, FilterPoints(disocclusion_taps, true), bias, light);
#endif
  return filtered(receiver, mean, FilterPoints(filter_taps, false), bias, light);
}
