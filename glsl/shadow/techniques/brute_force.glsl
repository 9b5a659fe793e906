// The thesis's reference: PCSS with so many taps that noise is gone, or with every texel of the disc.
#include "shadow/blockers.glsl"

float reach(Receiver receiver, Light light) { return search_reach(receiver, light); }

#if brute_force_every_texel

// Texels of the square about the receiver that is `radius` wide to each side.
struct Region {
  ivec2 low, high;
};

Region texels_within(Receiver receiver, float radius, Light light) {
  vec4 map = shadow.cascades[light.cascade].map;
  vec2 center = ((receiver.position.xy - map.xy) * map.z + 0.5) * shadow.light.w;
  vec2 reach = vec2(radius / map.w);
  ivec2 last = ivec2(shadow.light.w) - 1;
  return Region(clamp(ivec2(floor(center - reach)), ivec2(0), last),
                clamp(ivec2(floor(center + reach)), ivec2(0), last));
}

bool in_shape(vec2 offset, float radius, Light light) {
  return light.square ? max(abs(offset.x), abs(offset.y)) <= radius : length(offset) <= radius;
}

struct Texel {
  float depth;  // metres
  vec2 offset;  // of its centre from the receiver
  bool within;  // of the shape of that radius
};

Texel read_texel(Receiver receiver, ivec2 at, float radius, Light light) {
  CascadeBlock cascade = shadow.cascades[light.cascade];
  vec2 center = (vec2(at) + 0.5) * cascade.map.w - 0.5 / cascade.map.z + cascade.map.xy;
  Texel texel;
  texel.depth = depth_at(at, light);
  texel.offset = center - receiver.position.xy;
  texel.within = in_shape(texel.offset, radius, light);
  return texel;
}

bool in_cone(vec2 offset, float height, Light light) {
  return within_cone(light.tan_half_angle, light.square, vec4(offset.x), vec4(offset.y), vec4(height),
                     footprint_reach(light)).x != 0.0;
}

bool blocks(Receiver receiver, Texel texel, float bias) {
  return texel.depth < blocking_depths(receiver.position.z, receiver.gradient, receiver.corner, vec4(texel.offset.x),
                                       vec4(texel.offset.y), bias).x;
}

Visibility visibility(Receiver receiver, Light light) {
  float bias = depth_bias(receiver, light);
  receiver = receiver_in_corner(receiver, bias, cone_slope(light), light);
  // The map's own footprint belongs to both discs, as in add_blockers().
  float search = narrow_search(receiver, light, light.cascade, light.reach).radius + footprint_reach(light);
  Region region = texels_within(receiver, search, light);
  float sum = 0.0, count = 0.0;
  for (int y = region.low.y; y <= region.high.y; ++y) {
    for (int x = region.low.x; x <= region.high.x; ++x) {
      Texel texel = read_texel(receiver, ivec2(x, y), search, light);
      float distance_to = receiver.position.z - texel.depth;
      if (texel.within && in_cone(texel.offset, distance_to, light) && blocks(receiver, texel, bias)) {
        sum += distance_to;
        count += 1.0;
      }
    }
  }
  if (count == 0.0) return fully_lit();
  float mean = sum / count;
  float radius = light.tan_half_angle * mean;
  if (radius < texel_size(light)) return Visibility(lit_share(receiver, vec2(0.0), bias, light), radius, mean, true);
  region = texels_within(receiver, radius, light);
  float lit = 0.0, all = 0.0;
  for (int y = region.low.y; y <= region.high.y; ++y) {
    for (int x = region.low.x; x <= region.high.x; ++x) {
      Texel texel = read_texel(receiver, ivec2(x, y), radius, light);
      if (!texel.within) continue;
      all += 1.0;
      lit += blocks(receiver, texel, bias) ? 0.0 : 1.0;
    }
  }
  return Visibility(lit / max(all, 1.0), radius, mean, false);
}

#else

Visibility visibility(Receiver receiver, Light light) {
  return soft_shadow(receiver, light, brute_force_blocker_taps, brute_force_filter_taps, brute_force_filter_taps,
                     /* early_exits= */ false);
}

#endif
