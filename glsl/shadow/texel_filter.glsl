// Visibility from every texel of the map that can matter, for discs that are a few texels wide. There samples have
// noise that no denoiser can average over its neighbours, and the map's outlines are staircases. A texel hides the
// share of the light that a kernel for the disc at the texel's height gives it, and the kernels smooth staircases.
// After Guennebaud et al. 2006, "Real-time soft shadow mapping by backprojection"; see docs/techniques.md, "slices".
#include "shadow/search.glsl"
#include "shadow/second_layer.glsl"
#include "lib/rows.glsl"

// Lengths in this file are in texels, heights in metres.

// Variance of the distance between the map's outline and the caster's. Where the map is moved by a part of a texel in
// each frame, a history averages the outlines: then kernels are nearly as narrow as texels allow.
float outline_error() { return shadow.maps_are_moved != 0 ? 0.08 : 0.14; }

// Variance, along an axis, of what is drawn across an outline whose penumbra has that radius: of a disc, r² / 4.
vec4 drawn_variance(vec4 radii) { return 0.25 * radii * radii + outline_error(); }

// Variance of the narrowest kernel, which stands in where a penumbra is narrower: with less, staircases show. That of
// the cubic B-spline, but where maps are moved.
float least_variance() { return shadow.maps_are_moved != 0 ? 0.1 : 1.0 / 3.0; }

bvec4 are_least(vec4 radii) { return lessThan(drawn_variance(radii), vec4(least_variance())); }

// The narrowest kernel is (1 - d² / end²)³.
float least_end_squared() { return 10.0 * least_variance(); }

// Others fall from 1 to 0 over a rim, linearly in the squared distance: its middle, which is also the kernel's mass
// over pi, and half its width. Their variance is middle (1 + share² / 3) / 4, with the half width as a share of the
// middle.
struct Rim {
  vec4 middle, half_width;
};

Rim rim_of(vec4 radii) {
  const float narrow = 16.0 / 7.0;  // the rim is 1.5 texels wide in the end
  vec4 share_squared = narrow / (narrow + radii * radii);
  vec4 middle = 4.0 * drawn_variance(radii) / (1.0 + share_squared / 3.0);
  return Rim(middle, middle * sqrt(share_squared));
}

// Weights of texels at these squared distances in the kernels for discs of these radii.
vec4 kernel_weights(vec4 radii, vec4 squared) {
  Rim rim = rim_of(radii);
  vec4 of_disc = clamp(0.5 + 0.5 * (rim.middle - squared) / rim.half_width, 0.0, 1.0);
  vec4 least = max(1.0 - squared / least_end_squared(), 0.0);
  return mix(of_disc, least * least * least, are_least(radii));
}

// The integral of a kernel over the plane, divided by pi.
vec4 kernel_mass(vec4 radii) { return mix(rim_of(radii).middle, vec4(0.25 * least_end_squared()), are_least(radii)); }

float kernel_end(float radius) {
  Rim rim = rim_of(vec4(radius));
  return sqrt(are_least(vec4(radius)).x ? least_end_squared() : rim.middle.x + rim.half_width.x);
}

// The texels in which a kernel of a receiver lies, to be visited in squares of 2 × 2.
TexelRange kernel_texels(Receiver receiver, float radius, Light light) {
  vec2 end = kernel_end(radius) * texel_size(receiver, light) * outline_reach(light) / texel_extent(receiver, light);
  vec2 place = map_place(receiver.position, light) - 0.5;
  return TexelRange(ivec2(floor(place - end)) + 1, ivec2(floor(place + end)));
}

ivec2 next_square(ivec2 at, TexelRange range) { return next_in_rows(at, range.low.x, range.high.x, 2); }

// Squared distances from the receiver, of a square sun along the axis along which they are greater.
vec4 squared_distances(Receiver receiver, Offsets offsets, Light light) {
  float texel = texel_size(receiver, light);
  Outline at = from_outline(offsets.x / texel, offsets.y / texel, light);
  vec4 x = at.x * at.x, y = at.y * at.y;
  return light.square ? max(x, y) : x + y;
}

// Offsets of the texels `first` to first + (1, 1), as in footprint_from().
Offsets square_offsets(Receiver receiver, ivec2 first, Light light) {
  if (has_faces(light) && leaves_map(first, first + 1)) {
    return footprint_beyond(receiver, first, vec2(0.0), light).offsets;
  }
  return footprint_offsets(receiver, texel_offset(receiver, first, light), vec2(0.0), light);
}

struct HiddenLight {
  float share;  // times a constant: see most_hidden()
  float height_sum, least_height, most_height;
  bool everywhere;  // all texels block
};

// Whether what blocks is at different heights: then what it hides may overlap, or leave gaps that the map can't show.
bool heights_differ(HiddenLight hidden) { return hidden.least_height < least_share_of_height * hidden.most_height; }

// The least height, metres, of what blocks in these texels behind what the map shows; a large number where nothing
// does.
float least_height_behind(Receiver receiver, ivec2 first, Offsets offsets, float bias, Light light) {
#if READS_SECOND_LAYER
  vec4 depths = depths_behind(first, light);
  vec4 heights = receiver.position.z - depths;
  vec4 low = mix(vec4(1e30), heights, lessThan(depths, blocking_depths_at(receiver, offsets, bias)));
  return min(min(low.x, low.y), min(low.z, low.w));
#else
  return 1e30;
#endif
}

// What the texels hide, each with the kernel for its own height. `radius` bounds these discs: a surface without an edge
// may be far higher than the edges. `one_height`: ends where heights differ.
HiddenLight hidden_light(Receiver receiver, float radius, bool one_height, float bias, Light light) {
  TexelRange texels = kernel_texels(receiver, radius, light);
  float per_texel = 1.0 / texel_size(receiver, light), end = kernel_end(radius);
  HiddenLight hidden = HiddenLight(0.0, 0.0, 1e30, 0.0, true);
  ivec2 at = texels.low;
  do {
    Footprint square = footprint_from(receiver, at, texel_offset(receiver, at, light), vec2(0.0), light);
    vec4 heights = receiver.position.z - square.depths;
    vec4 radii = min(penumbra_radii(receiver, heights, light) * per_texel, radius);
    vec4 blocks = blocking_texels(receiver, square, bias);
    vec4 squared = squared_distances(receiver, square.offsets, light);
    vec4 shares = blocks * kernel_weights(radii, squared) / kernel_mass(radii);
    hidden.share += dot(shares, vec4(1.0));
    hidden.height_sum += dot(shares, heights);
    bvec4 is_blocker = greaterThan(blocks, vec4(0.0));
    vec4 low = mix(vec4(1e30), heights, is_blocker), high = mix(vec4(0.0), heights, is_blocker);
    hidden.least_height = min(hidden.least_height, min(min(low.x, low.y), min(low.z, low.w)));
    if (one_height)
      hidden.least_height = min(hidden.least_height, least_height_behind(receiver, at, square.offsets, bias, light));
    hidden.most_height = max(hidden.most_height, max(max(high.x, high.y), max(high.z, high.w)));
    hidden.everywhere = hidden.everywhere && all(greaterThan(blocks + step(end * end, squared), vec4(0.0)));
    at = next_square(at, texels);
  } while (at.y <= texels.high.y && !(one_height && heights_differ(hidden)));
  return hidden;
}

// What `share` would be if all texels blocked at a height whose disc has that radius. It is nearly the same everywhere,
// but not quite, since texels are few.
float most_hidden(Receiver receiver, float radius, Light light) {
  TexelRange texels = kernel_texels(receiver, radius, light);
  float sum = 0.0;
  ivec2 at = texels.low;
  do {
    vec4 squared = squared_distances(receiver, square_offsets(receiver, at, light), light);
    sum += dot(kernel_weights(vec4(radius), squared), vec4(1.0));
    at = next_square(at, texels);
  } while (at.y <= texels.high.y);
  return sum / kernel_mass(vec4(radius)).x;
}

// What is drawn where a kernel sees that share of the light. Across a straight outline the share rises like a normal
// distribution of the kernel's variance; this rises like one of the variance that is to be drawn.
float drawn_share(float seen, float radius) {
  float steepness = sqrt(max(least_variance() / drawn_variance(vec4(radius)).x, 1.0));
  float lit = pow(seen, steepness), hidden = pow(1.0 - seen, steepness);
  return lit / (lit + hidden);
}

struct FilteredTexels {
  Visibility seen;
  bool heights_differ;  // then nothing else is known
};

// `radius`, metres: everything that can block the receiver's light lies within it. Below a texel heights are not
// compared, since the map can't tell such discs apart.
FilteredTexels filter_texels(Receiver receiver, float radius, float bias, Light light) {
  float texel = texel_size(receiver, light);
  bool one_height = radius >= texel;
  HiddenLight hidden = hidden_light(receiver, radius / texel, one_height, bias, light);
  if (one_height && heights_differ(hidden)) return FilteredTexels(fully_lit(), true);
  if (hidden.share == 0.0) return FilteredTexels(without_noise(fully_lit()), false);
  float mean = max(hidden.height_sum / hidden.share, 0.0);
  float penumbra = penumbra_radius(receiver, mean, light);
  float lit = 0.0;
  if (!hidden.everywhere) {
    float drawn = min(penumbra, radius) / texel;
    lit = drawn_share(max(1.0 - hidden.share / most_hidden(receiver, drawn, light), 0.0), drawn);
  }
  return FilteredTexels(Visibility(lit, penumbra, mean, penumbra < texel, true), false);
}
