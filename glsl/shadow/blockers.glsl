// Percentage-closer soft shadows in parts (Fernando 2005): mean blocker depth, kernel, filter.
#include "shadow/search.glsl"

struct Blockers {
  float depth_sum;  // metres, relative to the receiver
  float weight;     // share of the texels read that block
};

// Texels about a receiver that may cover it though their centres lie outside of the light's cone.
float footprint_reach(Light light) { return 1.5 * texel_size(light); }

// Above this slope a surface beside the receiver lies within the light's cone.
float cone_slope(Light light) { return 1.0 / max(light.tan_half_angle, 1.0 / max_plane_slope); }

// 1 for those of the four texels about a point that lie within the cone that the light spans above the receiver: what is
// outside it can't hide the light, however wide the search.
vec4 texels_in_cone(Receiver receiver, Footprint footprint, Light light) {
  Offsets offsets = texel_offsets(footprint, texel_size(light));
  return within_cone(light.tan_half_angle, light.square, offsets.x, offsets.y, receiver.position.z - footprint.depths,
                     footprint_reach(light));
}

void add_blockers(inout Blockers blockers, Receiver receiver, vec2 offset, float bias, Light light) {
  Footprint footprint = fetch_footprint(receiver.position, offset, light);
  vec4 hides = texels_in_cone(receiver, footprint, light) * blocking_texels(receiver, footprint, bias, light);
  blockers.weight += bilinear(hides, footprint.weight);
  blockers.depth_sum += bilinear(hides * (receiver.position.z - footprint.depths), footprint.weight);
}

Blockers find_blockers(Receiver receiver, float radius, int taps, float bias, Light light) {
  Scramble scramble = scramble_of(receiver, blocker_step);
  Blockers blockers = Blockers(0.0, 0.0);
  for (int i = 0; i < taps; ++i) {
    add_blockers(blockers, receiver, radius * blocker_point(i, scramble, light), bias, light);
  }
  return blockers;
}

float mean_distance(Blockers blockers) { return max(blockers.depth_sum / blockers.weight, 0.0); }

// The filter's taps: how many, and whether of the set for refused histories.
struct Taps {
  int count;
  bool renewal;
};

vec2 tap_point(Taps taps, int index, Scramble scramble, Light light) {
  return taps.renewal ? renewal_point(index, scramble, light) : filter_point(index, scramble, light);
}

// Share of light that passes a disc (or square) of that radius about the receiver. `within_cone_only`: texels outside of
// the light's cone don't count.
float filtered_share(Receiver receiver, float radius, bool within_cone_only, Taps taps, float bias, Light light) {
  Scramble scramble = scramble_of(receiver, filter_step);
  float hidden = 0.0;
  for (int i = 0; i < taps.count; ++i) {
    Footprint footprint = fetch_footprint(receiver.position, radius * tap_point(taps, i, scramble, light), light);
    vec4 counts = within_cone_only ? texels_in_cone(receiver, footprint, light) : vec4(1.0);
    hidden += bilinear(counts * blocking_texels(receiver, footprint, bias, light), footprint.weight);
  }
  return 1.0 - hidden / float(taps.count);
}

// The second step. A few taps can miss blockers that hide little: then the filter's are asked over the widest kernel
// that there can be.
Visibility filtered(Receiver receiver, Blockers blockers, Search search, Taps taps, float bias, Light light) {
  bool found = blockers.weight > 0.0;
  float mean = found ? mean_distance(blockers) : 0.0;
  float radius = light.tan_half_angle * mean;
  float lit = filtered_share(receiver, found ? radius : search.radius, !found, taps, bias, light);
  return Visibility(lit, radius, mean, found && radius < texel_size(light));
}

// Both steps with so many taps each, and so many where the history is refused; neither where depth bounds, if asked,
// rule blockers out.
Visibility soft_shadow(Receiver receiver, Light light, int blocker_taps, int filter_taps, int renewal_taps,
                       bool early_exits) {
  float bias = depth_bias(receiver, light);
  Search search = narrow_search(receiver, light, light.cascade, light.reach);
  if (early_exits && search.nearest >= receiver.position.z - bias) return fully_lit();
  receiver = receiver_in_corner(receiver, bias, cone_slope(light), light);
  Blockers blockers = find_blockers(receiver, search.radius, blocker_taps, bias, light);
  if (receiver.renewed) {
    return filtered(receiver, blockers, search, Taps(renewal_taps, true), bias, light);
  }
  return filtered(receiver, blockers, search, Taps(filter_taps, false), bias, light);
}
