// PCSS with so many taps that no noise is visible, or, as the thesis's reference, with every texel of the disc.
const bool blocker_footprints = true;
#include "shadow/blockers.glsl"

float read_radius(Receiver receiver, Light light) { return search_radius(receiver, light); }

#if brute_force_every_texel

// The texels of the square around the receiver that extends `radius` to each side.
TexelRange texels_within(Receiver receiver, float radius, Light light) {
  vec2 center = map_place(receiver.position, light);
  vec2 texels = radius * outline_reach(light) / texel_extent(receiver, light);
  return TexelRange(clamp(ivec2(floor(center - texels)), ivec2(0), last_texel()),
                    clamp(ivec2(floor(center + texels)), ivec2(0), last_texel()));
}

bool in_shape(vec2 offset, float radius, Light light) {
  Outline place = from_outline(vec4(offset.x), vec4(offset.y), light);
  offset = vec2(place.x.x, place.y.x);
  return light.square ? max(abs(offset.x), abs(offset.y)) <= radius : length(offset) <= radius;
}

struct Texel {
  float depth;  // metres
  vec2 offset;  // of its centre from the receiver
  bool within;  // of the shape of that radius
};

Texel read_texel(Receiver receiver, ivec2 at, float radius, Light light) {
  Texel texel;
  texel.depth = depth_at(at, light);
  texel.offset = texel_offset(receiver, at, light);
  texel.within = in_shape(texel.offset, radius, light);
  return texel;
}

// The texel in the form that functions for four texels take.
Offsets offsets_of(Texel texel) { return Offsets(vec4(texel.offset.x), vec4(texel.offset.y)); }

bool in_cone(Receiver receiver, Texel texel, float distance_to, Light light) {
  return in_light_cone(receiver, offsets_of(texel), vec4(distance_to), light).x != 0.0;
}

bool blocks(Receiver receiver, Texel texel, float bias) {
  return texel.depth < blocking_depths_at(receiver, offsets_of(texel), bias).x;
}

Visibility visibility(Receiver receiver, Light light) {
  float bias = depth_bias(receiver, light);
  receiver = with_surroundings(receiver, bias, cone_slope(receiver, light), light);
  // The map's own footprint belongs to both discs, as in add_blockers().
  float search =
      narrow_search(receiver, light, light.read_radius).radius + footprint_margin(receiver, light);
  TexelRange region = texels_within(receiver, search, light);
  float sum = 0.0, count = 0.0;
  ivec2 at = region.low;
  do {
    Texel texel = read_texel(receiver, at, search, light);
    float distance_to = receiver.position.z - texel.depth;
    if (texel.within && in_cone(receiver, texel, distance_to, light) && blocks(receiver, texel, bias)) {
      sum += distance_to;
      count += 1.0;
    }
    at = next_texel(at, region);
  } while (at.y <= region.high.y);
  if (count == 0.0) return fully_lit();
  float mean = max(sum / count, 0.0);
  float radius = penumbra_radius(receiver, mean, light);
  if (radius < texel_size(receiver, light)) {
    return Visibility(lit_share(receiver, vec2(0.0), bias, light), radius, mean, true, false);
  }
  region = texels_within(receiver, radius, light);
  float lit = 0.0, all = 0.0;
  at = region.low;
  do {
    Texel texel = read_texel(receiver, at, radius, light);
    if (texel.within) {
      all += 1.0;
      lit += blocks(receiver, texel, bias) ? 0.0 : 1.0;
    }
    at = next_texel(at, region);
  } while (at.y <= region.high.y);
  return Visibility(lit / max(all, 1.0), radius, mean, false, false);
}

#else

Visibility visibility(Receiver receiver, Light light) {
  return soft_shadow(receiver, light, brute_force_blocker_taps, brute_force_filter_taps, brute_force_filter_taps,
                     /* early_exits= */ false);
}

#endif
