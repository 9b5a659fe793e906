// Variance soft shadow maps: both steps of percentage-closer soft shadows read the mean and the variance of depth in a
// kernel from a summed-area table. See docs/techniques.md.
#include "lib/rows.glsl"
#include "shadow/search.glsl"
#include "shadow/sampling.glsl"
#include "shadow/depth_moments.glsl"
#include "shadow/greatest_depth.glsl"

float read_radius(Receiver receiver, Light light) { return search_radius(receiver, light); }

// What is known of a part of the map.
struct Share {
  float hidden;      // share of it that blocks
  float height_sum;  // metres along the light: mean height of the blockers over the receiver, times `hidden`
};

// Every texel of a small rectangle around the receiver, weighted by the area in common.
Share compared_texels(Receiver receiver, vec2 half_width, float bias, Light light) {
  vec2 texel = texel_extent(receiver, light);
  half_width = max(half_width, 0.5 * texel);
  vec2 place = map_place(receiver.position, light);
  ivec2 first = ivec2(floor(place - half_width / texel)), last = ivec2(floor(place + half_width / texel));
  Share share = Share(0.0, 0.0);
  ivec2 block = first;
  do {
    vec4 depths = depths_from(block, light);
    vec2 low = texel_offset(receiver, block, light);
    Offsets at = Offsets(low.x + texel.x * vec4(0.0, 1.0, 1.0, 0.0), low.y + texel.y * vec4(1.0, 1.0, 0.0, 0.0));
    vec4 width = max(min(at.x + 0.5 * texel.x, half_width.x) - max(at.x - 0.5 * texel.x, -half_width.x), 0.0);
    vec4 height = max(min(at.y + 0.5 * texel.y, half_width.y) - max(at.y - 0.5 * texel.y, -half_width.y), 0.0);
    vec4 blocks = width * height * vec4(lessThan(depths, blocking_depths_at(receiver, at, bias)));
    share.hidden += dot(blocks, vec4(1.0));
    share.height_sum += dot(blocks, receiver.position.z - depths);
    block = next_in_rows(block, first.x, last.x, 2);
  } while (block.y <= last.y);
  float area = 4.0 * half_width.x * half_width.y;
  return Share(share.hidden / area, share.height_sum / area);
}

// 1 for blockers at these heights that can hide a part of the light, where texels are at such offsets; else 0. In the
// filter step, where `in_cone` is false, all count.
vec4 counting(Receiver receiver, Offsets at, vec4 heights, float margin, bool in_cone, Light light) {
  if (!in_cone) return vec4(1.0);
  return within_cone(penumbra_radii(receiver, heights, light) + margin, is_square(light), at.x, at.y);
}

// Points in a part of a kernel, compared.
Share compared_points(Receiver receiver, vec2 offset, vec2 half_width, vec2 noise, float bias, bool in_cone,
                      Light light) {
  Share share = Share(0.0, 0.0);
  int i = 0;
  do {
    vec2 cell = vec2(i % vssm_taps, i / vssm_taps);
    vec2 at = offset + half_width * (2.0 * (cell + noise) / float(vssm_taps) - 1.0);
    Footprint footprint = fetch_footprint(receiver, at, light);
    vec4 heights = receiver.position.z - footprint.depths;
    vec4 blocks = blocking_texels(receiver, footprint, bias);
    blocks *= counting(receiver, footprint.offsets, heights, 1.5 * texel_size(receiver, light), in_cone, light);
    share.hidden += bilinear(blocks, footprint.weight);
    share.height_sum += bilinear(blocks * heights, footprint.weight);
  } while (++i < vssm_taps * vssm_taps);
  float points = float(vssm_taps * vssm_taps);
  return Share(share.hidden / points, share.height_sum / points);
}

// In units of the blockers' mean height: what may lie behind the receiver's own plane, and how far that plane may
// depart from its middle. Found by comparing pictures with the truth: see docs/techniques.md.
const float greatest_behind = 0.03, greatest_tilt = 0.05;

// The share of a part by Chebyshev's inequality, which is an equality for two planes that face the light, one of them
// the receiver's. Returns false where mean and variance do not suffice.
bool share_by_moments(Receiver receiver, vec2 offset, vec2 half_width, float bias, Light light, out Share share) {
  vec3 middle = receiver.position + vec3(offset, 0.0);
  Moments moments = depth_moments(middle, half_width, light);
  Offsets at = Offsets(vec4(offset.x), vec4(offset.y));
  float blocking = blocking_depths_at(receiver, at, bias).x - receiver.position.z;
  float tilt = dot(abs(receiver.gradient), half_width);
  float variance = variance_of(moments);
  float in_front = blocking - moments.mean;
  share = Share(0.0, 0.0);
  // As flat as the receiver's own plane, whose variance is at most a third of tilt²: nothing else is in it.
  bool flat_part = variance <= 0.4 * tilt * tilt + bias * bias;
  if (in_front <= (flat_part ? 0.2 * tilt + bias : 0.0)) return flat_part;
  float behind = greatest_near(middle, max(half_width.x, half_width.y), light) - receiver.position.z - blocking;
  // Equations 2.22 and 2.23 of the thesis (Yang et al. 2010), solved for the blockers' mean height.
  float height = in_front + variance / in_front;
  // The pyramid's texels can reach as far again beyond the part as the part itself: hence twice the tilt.
  if (behind < -2.0 * tilt) {
    share = Share(1.0, in_front - blocking);
    return true;
  }
  if (behind > 2.0 * tilt + greatest_behind * height || tilt > greatest_tilt * height) return false;
  float hidden = in_front / height;
  share = Share(hidden, max(in_front - hidden * blocking, 0.0));
  return true;
}

// A part of a kernel, of which only blockers within the light's cone count if `in_cone`.
Share part_share(Receiver receiver, vec2 offset, vec2 half_width, vec2 noise, float bias, bool in_cone, Light light) {
  Share share;
  if (!share_by_moments(receiver, offset, half_width, bias, light, share)) {
    return compared_points(receiver, offset, half_width, noise, bias, in_cone, light);
  }
  if (!in_cone) return share;
  // How much of the part lies within the cone at its blockers' mean height.
  float cone = penumbra_radius(receiver, share.height_sum / max(share.hidden, 1e-6), light);
  vec2 distance_to = is_square(light) ? vec2(max(abs(offset.x), abs(offset.y)), max(half_width.x, half_width.y))
                                      : vec2(length(offset), length(half_width));
  float counts = clamp(0.5 * (cone + distance_to.y - distance_to.x) / distance_to.y, 0.0, 1.0);
  return Share(counts * share.hidden, counts * share.height_sum);
}

// A kernel around the receiver: all its texels if it is small, else its moments or those of its parts.
Share kernel_share(Receiver receiver, float radius, int step, float bias, Light light) {
  bool search = step == blocker_step;
  vec2 half_width = vec2(square_half(radius, light));
  vec2 texels = half_width / texel_extent(receiver, light);
  if (max(texels.x, texels.y) <= vssm_small) return compared_texels(receiver, half_width, bias, light);
  Share share;
  if (!search && share_by_moments(receiver, vec2(0.0), half_width, bias, light, share)) return share;
  vec2 noise = pixel_noise(receiver, step);
  vec2 part = half_width / float(vssm_cells);
  Share sum = Share(0.0, 0.0);
  int i = 0;
  do {
    vec2 offset = part * (2.0 * vec2(i % vssm_cells, i / vssm_cells) + 1.0) - half_width;
    share = part_share(receiver, offset, part, noise, bias, search, light);
    sum.hidden += share.hidden;
    sum.height_sum += share.height_sum;
  } while (++i < vssm_cells * vssm_cells);
  float parts = float(vssm_cells * vssm_cells);
  return Share(sum.hidden / parts, sum.height_sum / parts);
}

Visibility visibility(Receiver receiver, Light light) {
  float bias = depth_bias(receiver, light);
  Search search = narrow_search(receiver, light, light.read_radius);
  if (search.nearest >= receiver.position.z - bias) return fully_lit();
  receiver = with_surroundings(receiver, bias, cone_slope(receiver, light), light);
  float texel = texel_size(receiver, light);
  Visibility centre = centre_shadow(receiver, bias, light);
  // No edge is so near that it could make a penumbra.
  if (edge_radius(receiver, reading_centre(centre, light)) < 0.5 * texel) return centre;
  search.radius = max(search.radius, centre.penumbra_radius);
  float reach = search.radius + 1.5 * texel;
  float least_blocking = receiver.position.z - bias - reach * length(receiver.gradient);
  bool dark = greatest_near(receiver.position, reach, light) < least_blocking;
  Share found = kernel_share(receiver, search.radius, blocker_step, bias, light);
  // Near the receiver the cone is narrow, so that a search of a wide disc can miss a blocker that touches the receiver.
  // Less than this share is what roundness of the ground looks like; no height can be taken from it.
  const float least_found = 0.004;
  if (found.hidden < least_found) found = compared_texels(receiver, vec2(0.0), bias, light);
  if (found.hidden <= 0.0 && !dark) return fully_lit();
  float mean = clamp(found.height_sum / max(found.hidden, 1e-6), 0.0, receiver.position.z - search.nearest);
  float penumbra = penumbra_radius(receiver, mean, light);
  float hidden = dark ? 1.0 : min(kernel_share(receiver, penumbra, filter_step, bias, light).hidden, 1.0);
  return Visibility(1.0 - hidden, penumbra, mean, penumbra < texel, false);
}
