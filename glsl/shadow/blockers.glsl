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

// Of the four texels about a point those that hide a part of the light: 1, else 0. Such a texel lies before the receiver
// and its plane, and within the cone that the light spans above the receiver: what is outside it can't hide the light,
// however wide the search.
vec4 hiding_texels(Receiver receiver, Footprint footprint, float bias, Light light) {
  Offsets offsets = texel_offsets(footprint, texel_size(light));
  vec4 inside = within_cone(light.tan_half_angle, light.square, offsets.x, offsets.y,
                            receiver.position.z - footprint.depths, footprint_reach(light));
  return inside * blocking_texels(receiver, footprint, bias, light);
}

void add_blockers(inout Blockers blockers, Receiver receiver, vec2 offset, float bias, Light light) {
  Footprint footprint = fetch_footprint(receiver.position, offset, light);
  vec4 hides = hiding_texels(receiver, footprint, bias, light);
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

vec2 tap_point(Receiver receiver, int index, Scramble scramble, Light light) {
  return receiver.renewed ? renewal_point(index, scramble, light) : filter_point(index, scramble, light);
}

// Share of light that passes a disc (or square) of that radius about the receiver.
float filtered_share(Receiver receiver, float radius, int taps, float bias, Light light) {
  if (radius <= 0.0) return lit_share(receiver, vec2(0.0), bias, light);
  Scramble scramble = scramble_of(receiver, filter_step);
  float lit = 0.0;
  for (int i = 0; i < taps; ++i) {
    lit += lit_share(receiver, radius * tap_point(receiver, i, scramble, light), bias, light);
  }
  return lit / float(taps);
}

// The same, but for what lies outside of the light's cone.
float unhidden_share(Receiver receiver, float radius, int taps, float bias, Light light) {
  Scramble scramble = scramble_of(receiver, filter_step);
  float hidden = 0.0;
  for (int i = 0; i < taps; ++i) {
    vec2 offset = radius * tap_point(receiver, i, scramble, light);
    Footprint footprint = fetch_footprint(receiver.position, offset, light);
    hidden += bilinear(hiding_texels(receiver, footprint, bias, light), footprint.weight);
  }
  return 1.0 - hidden / float(taps);
}

// Both steps with so many taps each; neither where depth bounds, if asked, rule blockers out.
Visibility soft_shadow(Receiver receiver, Light light, int blocker_taps, int filter_taps, bool early_exits) {
  float bias = depth_bias(receiver, light);
  Search search = narrow_search(receiver, light, light.cascade, light.reach);
  if (early_exits && search.nearest >= receiver.position.z - bias) return fully_lit();
  receiver = receiver_in_corner(receiver, bias, cone_slope(light), light);
  Blockers blockers = find_blockers(receiver, search.radius, blocker_taps, bias, light);
  // A few taps can miss blockers that hide little: the filter's are asked too, over the widest kernel that there can be.
  if (blockers.weight == 0.0) {
    return Visibility(unhidden_share(receiver, search.radius, filter_taps, bias, light), 0.0, 0.0, false);
  }
  float mean = mean_distance(blockers);
  float radius = light.tan_half_angle * mean;
  return Visibility(filtered_share(receiver, radius, filter_taps, bias, light), radius, mean,
                    radius < texel_size(light));
}
