// Blends a pixel with what the last frame's history holds of it: exponential smoothing (Deligiannis 2019, 2.28).
#include "shadow/history.glsl"

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

// Weight of the present frame. Each bilinear look-up blurs by a variance of x(1 − x) pixels squared, with x the fraction
// of a pixel that was moved by, and a weight of α lets (1 − α)/α of that add up: no more than the variance that the
// visibility filter has leave to blur by. So narrow penumbrae stay sharp while the camera moves, and have little noise.
float present_weight(Reprojection last, Receiver receiver, float distance_to) {
  vec2 part = vec2(last.weights.y + last.weights.w, last.weights.z + last.weights.w);
  vec2 blur = part * (1.0 - part);
  float variance = max(blur.x, blur.y);
  float sigma = filter_width * 2.0 * shadow.light.x * distance_to / pixel_width(receiver_view_position(receiver));
  return variance > 0.0 ? max(history_alpha, variance / (variance + sigma * sigma)) : history_alpha;
}

Kept blend(ivec2 pixel) {
  uint now = texelFetch(texels, pixel, 0).x;
  if (is_sky(pixel)) return Kept(now, uvec2(floatBitsToUint(shadow.depth_to_ndc.z), 0u));
  Receiver receiver = receiver_at(pixel);
  uvec2 surface = surface_bits(pixel, receiver);
  if (texel_invalid(now)) return Kept(now, surface);
  Reprojection last = reproject(receiver, pixel);
  float weight = present_weight(last, receiver, texel_distance(now));
  float visibility = mix(last_visibility(last), texel_visibility(now), weight);
  return Kept(pack_texel(texel_distance(now), visibility, false), surface);
}
