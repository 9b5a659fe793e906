// The receiver under a pixel of the caller's depth and normals. Included after shadow/receive.glsl.
#include "lib/octahedral.glsl"

layout(binding = 2) uniform sampler2D receiver_depth;
layout(binding = 3) uniform sampler2D receiver_normal;

// The mask's texel for a pixel: lit where there is only sky.
vec4 shade_pixel(ivec2 pixel) {
  float depth = texelFetch(receiver_depth, pixel, 0).x;
  if (depth == shadow.depth_to_ndc.z) return vec4(1.0, 0.0, 0.0, 0.0);
  vec2 ndc = (vec2(pixel) + 0.5) / shadow.viewport.xy * 2.0 - 1.0 - shadow.viewport.zw;
  vec4 view = shadow.clip_to_view * vec4(ndc, depth * shadow.depth_to_ndc.x + shadow.depth_to_ndc.y, 1.0);
  vec4 stored = texelFetch(receiver_normal, pixel, 0);
  vec3 normal = shadow.depth_to_ndc.w != 0.0 ? octahedral_decode(stored.xy) : normalize(stored.xyz);
  return mask_texel(shade(make_receiver(view.xyz / view.w, mat3(shadow.world_to_light) * normal, vec2(pixel))));
}
