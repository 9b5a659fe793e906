// Computes the lighting of the G-buffer's surfaces. LIGHTS: how many lights there are; SHADOWED: how many of them have
// a layer of the mask. FURTHER_SAMPLE: 1 for a further sample of each pixel, which sees the shadows of the first.
#include "lib/octahedral.glsl"
#include "render/shade.glsl"

layout(location = 0) noperspective in vec3 view_ray;  // as in lighting.vert
layout(location = 1) flat in AmbientLight ambient;

layout(binding = 8) uniform sampler2D gbuffer_albedo;
layout(binding = 9) uniform sampler2D gbuffer_normal;
layout(binding = 10) uniform sampler2D gbuffer_material;
layout(binding = 11) uniform sampler2DArray shadow_mask;  // one layer for each light
#if EMISSION
layout(binding = 12) uniform sampler2D gbuffer_emission;
#endif

#if LAMPS || FURTHER_SAMPLE
#include "shared/view_block.h"

layout(std140, binding = 4) uniform ViewData { ViewBlock view; };
#endif

#if FURTHER_SAMPLE
layout(binding = 14) uniform sampler2D gbuffer_geometric_normal;
layout(binding = 15) uniform sampler2D first_depth;
layout(binding = 16) uniform sampler2D first_normal;  // geometric
#include "render/first_mask.glsl"
#endif

#if LAMPS || FURTHER_SAMPLE
layout(binding = 13) uniform sampler2D gbuffer_depth;
#include "render/position_at.glsl"
#endif

layout(location = 0) out vec4 lit;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 albedo = texelFetch(gbuffer_albedo, pixel, 0);
  vec4 material = texelFetch(gbuffer_material, pixel, 0);
  Shading s;
#if LAMPS || FURTHER_SAMPLE
  s.position = position_at(pixel);
#endif
  s.albedo = albedo.rgb * albedo.rgb;
  s.normal = octahedral_decode(texelFetch(gbuffer_normal, pixel, 0).xy * 2.0 - 1.0);
  s.smooth_lean = material.a;
  s.to_eye = -normalize(view_ray);
  s.metallic = material.r;
  s.roughness = material.g;
  s.occlusion = material.b;
#if EMISSION
  s.emission = texelFetch(gbuffer_emission, pixel, 0).rgb;
#else
  s.emission = vec3(0.0);
#endif
  vec3 color = s.albedo;
  if (albedo.a > 0.5) {
    Reflection r = reflection_of(s);
    vec3 radiance = unshadowed_light(s, r, ambient);
#if FURTHER_SAMPLE
    vec3 geometric = octahedral_decode(texelFetch(gbuffer_geometric_normal, pixel, 0).xy);
    MaskTexels at = mask_texels(pixel, sample_surface(s.position, geometric));
#define VISIBILITY(light) visibility_at(at, light)
#else
#define VISIBILITY(light) texelFetch(shadow_mask, ivec3(pixel, light), 0).r
#endif
    for (int i = 0; i < LIGHTS; ++i) add_light(radiance, s, r, i, i < SHADOWED ? VISIBILITY(i) : 1.0);
    color = storable(radiance);
  }
  lit = vec4(color, 1.0);
}
