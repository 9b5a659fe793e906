// Computes the lighting of the G-buffer, and the sky where no surface is. LIGHTS: how many lights there are; SHADOWED:
// how many of them have a layer of the mask.
#include "shared/view_block.h"
#include "lib/octahedral.glsl"
#include "render/shade.glsl"

layout(std140, binding = 4) uniform ViewData { ViewBlock view; };

layout(binding = 8) uniform sampler2D gbuffer_albedo;
layout(binding = 9) uniform sampler2D gbuffer_normal;
layout(binding = 10) uniform sampler2D gbuffer_material;
layout(binding = 11) uniform sampler2DArray shadow_mask;  // one layer for each light
#if EMISSION
layout(binding = 12) uniform sampler2D gbuffer_emission;
#endif

#if LAMPS
layout(binding = 13) uniform sampler2D gbuffer_depth;

uniform mat4 clip_to_world;

vec3 position_at(ivec2 pixel, vec2 ndc) {
  float depth = texelFetch(gbuffer_depth, pixel, 0).x;
  vec4 world = clip_to_world * vec4(ndc, depth, 1.0);
  return world.xyz / world.w;
}
#endif

layout(location = 0) out vec4 lit;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec2 ndc = gl_FragCoord.xy * view.viewport.zw * 2.0 - 1.0;
  vec3 ray = normalize(view.forward.xyz + ndc.x * view.ray_x.xyz + ndc.y * view.ray_y.xyz);
  vec4 albedo = texelFetch(gbuffer_albedo, pixel, 0);
  vec4 material = texelFetch(gbuffer_material, pixel, 0);
  Shading s;
#if LAMPS
  s.position = position_at(pixel, ndc);
#endif
  s.albedo = albedo.rgb * albedo.rgb;
  s.normal = octahedral_decode(texelFetch(gbuffer_normal, pixel, 0).xy * 2.0 - 1.0);
  s.to_eye = -ray;
  s.metallic = material.r;
  s.roughness = material.g;
  s.occlusion = material.b;
#if EMISSION
  s.emission = texelFetch(gbuffer_emission, pixel, 0).rgb;
#else
  s.emission = vec3(0.0);
#endif
  bool sky = albedo.a == 0.0;
  // What the eye sees beyond the scene, or the surface mirrors.
  vec3 beyond = surroundings(sky ? ray : reflect(ray, s.normal), sky ? 0.02 : s.roughness);
  vec3 color = sky ? beyond : s.albedo;
  if (albedo.a > 0.5) {
    Reflection r = reflection_of(s);
    vec3 radiance = unshadowed_light(s, r, beyond);
    for (int i = 0; i < LIGHTS; ++i) {
      add_light(radiance, s, r, i, i < SHADOWED ? texelFetch(shadow_mask, ivec3(pixel, i), 0).r : 1.0);
    }
    color = storable(radiance);
  }
  lit = vec4(color, 1.0);
}
