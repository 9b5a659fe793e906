// Blends a pixel with its history from the last frame: exponential smoothing (Deligiannis 2019, 2.28).
#include "shadow/history.glsl"
#include "shadow/drivers/kernel.glsl"

layout(binding = 11) uniform usampler2D last_texels;
layout(binding = 12) uniform usampler2D texels;

struct Kept {
  uint texel;
  uvec2 surface;
};

float last_visibility(Reprojection last) {
  float sum = 0.0;
  for (int i = 0; i < 4; ++i) {
    if (last.weights[i] == 0.0) continue;
    ivec2 tap = last.corner + ivec2(i & 1, i >> 1) + ivec2(shadow.viewport.xy);
    sum += last.weights[i] * texel_visibility(texelFetch(last_texels, tap, 0).x);
  }
  return sum;
}

// How many frames the history averages: the least of the four pixels.
uint last_frames(Reprojection last) {
  uint least = most_frames;
  for (int i = 0; i < 4; ++i) {
    if (last.weights[i] == 0.0) continue;
    ivec2 tap = last.corner + ivec2(i & 1, i >> 1) + ivec2(shadow.viewport.xy);
    least = min(least, texel_frames(texelFetch(last_texels, tap, 0).x));
  }
  return least;
}

// Least mean blocker distance, metres, among a pixel and its neighbours, because the narrowest penumbra must not be
// blurred. At a penumbra's rim, where few blocker taps may find no blocker, a neighbour's distance is used.
float penumbra_distance(ivec2 pixel, uint texel) {
  const ivec2 moves[4] = ivec2[4](ivec2(2, 1), ivec2(-1, 2), ivec2(-2, -1), ivec2(1, -2));
  ivec2 low = ivec2(shadow.viewport.xy);
  ivec2 high = low + ivec2(shadow.viewport.zw) - 1;
  float least = texel_distance(texel);
  for (int i = 0; i < 4; ++i) {
    float beside = texel_distance(texelFetch(texels, clamp(pixel + moves[i], low, high), 0).x);
    if (least == 0.0 || (beside > 0.0 && beside < least)) least = beside;
  }
  return least;
}

// Weight of the present frame. Each look-up blurs: the squared distances, in pixels, of the weighted pixels from the
// receiver's last position have the mean x(1 − x) where all four count, x being the fractional part of the motion, and
// up to 1 where some show other surfaces, which also shifts what is read. With a weight of α this accumulates to
// (1 − α)/α times as much. `alpha` is raised so that the accumulated blur is no wider than the visibility filter's
// kernel: narrow penumbrae, which have little noise, stay sharp while the camera moves.
float present_weight(Reprojection last, Receiver receiver, float distance_to, float alpha) {
  vec2 high = vec2(last.weights.y + last.weights.w, last.weights.z + last.weights.w);
  vec2 variance = mix(last.part * last.part, (1.0 - last.part) * (1.0 - last.part), high);
  vec2 pixels = pixels_on_plane(view_position_of(receiver), view_normal_of(receiver));
  vec2 sigma = sigma_for(receiver.position, pixels, distance_to);
  vec2 weight = variance / max(variance + sigma * sigma, 1e-6);
  return max(alpha, max(weight.x, weight.y));
}

Kept blend(ivec2 pixel) {
  uint now = texelFetch(texels, pixel, 0).x;
  if (is_sky(pixel)) return Kept(now, uvec2(floatBitsToUint(shadow.sky_depth), 0u));
  Receiver receiver = receiver_at(pixel);
  uvec2 surface = surface_bits(pixel, receiver);
  bool counts = history_mean != 0;
  uint first = counts ? with_frames(now, 1u) : now;
  if (texel_invalid(now)) return Kept(first, surface);
  // The mask pass accepted the history, but this program may round differently and reject it.
  Reprojection last = reproject(receiver, pixel);
  if (last.refusal != HISTORY_KEPT) return Kept(first, surface);
  uint frames = last_frames(last) + 1u;
  float alpha = counts && frames <= most_frames ? max(history_alpha, 1.0 / float(frames)) : history_alpha;
  float weight = present_weight(last, receiver, penumbra_distance(pixel, now), alpha);
  float visibility = mix(last_visibility(last), texel_visibility(now), weight);
  uint texel = pack_texel(texel_distance(now), visibility, false);
  // An exponential mean with a weight of α has the variance of a mean over 2/α − 1 frames.
  if (counts) texel = with_frames(texel, min(min(frames, uint(2.0 / weight - 0.5)), most_frames));
  return Kept(texel, surface);
}
