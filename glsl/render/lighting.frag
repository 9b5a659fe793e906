// Computes the lighting of the G-buffer, and the sky where no surface is. LIGHTS: how many lights there are.
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

layout(location = 0) out vec4 lit;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec2 ndc = gl_FragCoord.xy * view.viewport.zw * 2.0 - 1.0;
  vec3 ray = normalize(view.forward.xyz + ndc.x * view.ray_x.xyz + ndc.y * view.ray_y.xyz);
  vec4 albedo = texelFetch(gbuffer_albedo, pixel, 0);
  vec4 material = texelFetch(gbuffer_material, pixel, 0);
  Shading s;
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
      add_light(radiance, s, r, i, texelFetch(shadow_mask, ivec3(pixel, i), 0).r);
    }
    color = storable(radiance);
  }
  lit = vec4(color, 1.0);
}
