// Reads receivers from the caller's depth and normals, for a technique's own passes.
#include "shadow/light.glsl"
#include "lib/octahedral.glsl"

layout(binding = 2) uniform sampler2D receiver_depth;
layout(binding = 3) uniform sampler2D receiver_normal;

// Whether the pixel shows only sky.
bool is_sky(ivec2 pixel) { return texelFetch(receiver_depth, pixel, 0).x == shadow.sky_depth; }

// View-space position (metres) of a point of the picture, pixels, with that stored depth.
vec3 unproject(vec2 at, float depth) {
  vec2 ndc = (at - shadow.viewport.xy) / shadow.viewport.zw * 2.0 - 1.0 - shadow.jitter.xy;
  vec4 view = shadow.clip_to_view * vec4(ndc, depth * shadow.depth_to_ndc.x + shadow.depth_to_ndc.y, 1.0);
  return view.xyz / view.w;
}

// View-space position (metres) of a pixel that is not sky.
vec3 view_position_at(ivec2 pixel) { return unproject(vec2(pixel) + 0.5, texelFetch(receiver_depth, pixel, 0).x); }

// Geometric normal of a pixel that is not sky, light space.
vec3 light_normal_at(ivec2 pixel) {
  vec4 stored = texelFetch(receiver_normal, pixel, 0);
  vec3 normal = shadow.octahedral_normals != 0 ? octahedral_decode(stored.xy) : normalize(stored.xyz);
  return light_direction(normal);
}

Receiver receiver_at(ivec2 pixel) {
  return make_receiver(view_position_at(pixel), light_normal_at(pixel), vec2(pixel));
}
