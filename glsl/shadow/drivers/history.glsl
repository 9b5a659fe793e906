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

Kept blend(ivec2 pixel) {
  uint now = texelFetch(texels, pixel, 0).x;
  if (is_sky(pixel)) return Kept(now, uvec2(floatBitsToUint(shadow.depth_to_ndc.z), 0u));
  Receiver receiver = receiver_at(pixel);
  uvec2 surface = surface_bits(pixel, receiver);
  if (texel_invalid(now)) return Kept(now, surface);
  float visibility = mix(last_visibility(reproject(receiver, pixel)), texel_visibility(now), history_alpha);
  return Kept(pack_texel(texel_distance(now), visibility, false), surface);
}
