// Metallic-roughness shading as glTF 2.0, appendix B: the sun, and light from all around.
#include "lib/brdf.glsl"
#include "render/sky.glsl"

struct Shading {
  vec3 albedo;
  vec3 normal;  // unit, world
  vec3 to_eye;  // unit, world
  vec3 emission;
  float metallic;
  float roughness;
  float occlusion;
};

// From the sun, per unit of its visibility.
vec3 sunlight(Shading s, vec3 diffuse, vec3 reflectance) {
  float n_dot_l = dot(s.normal, lighting.to_sun.xyz);
  if (n_dot_l <= 0.0) return vec3(0.0);
  vec3 half_vector = normalize(lighting.to_sun.xyz + s.to_eye);
  float n_dot_v = max(dot(s.normal, s.to_eye), 1e-4);
  // The sun is no point: below this its highlight would be smaller than itself.
  float alpha = max(s.roughness * s.roughness, 0.005);
  vec3 fresnel = mix(reflectance, vec3(1.0), schlick_weight(dot(s.to_eye, half_vector)));
  float lobe = ggx_distribution(clamp(dot(s.normal, half_vector), 0.0, 1.0), alpha) *
               smith_visibility(n_dot_l, n_dot_v, alpha);
  vec3 brdf = (1.0 - fresnel) * diffuse / brdf_pi + fresnel * lobe;
  return lighting.sun.rgb * n_dot_l * brdf;
}

vec3 skylight(Shading s, vec3 diffuse, vec3 reflectance) {
  float n_dot_v = clamp(dot(s.normal, s.to_eye), 0.0, 1.0);
  vec2 scale_bias = environment_brdf(s.roughness, n_dot_v);
  vec3 all_around = ambient(s.normal);
  vec3 mirrored = mix(surroundings(reflect(-s.to_eye, s.normal), s.roughness), all_around, s.roughness);
  return s.occlusion * (diffuse * all_around + (reflectance * scale_bias.x + scale_bias.y) * mirrored);
}

vec3 shade(Shading s, float sun_visibility) {
  vec3 diffuse = s.albedo * (1.0 - s.metallic);
  vec3 reflectance = mix(vec3(0.04), s.albedo, s.metallic);
  vec3 radiance = skylight(s, diffuse, reflectance) + s.emission * lighting.to_sun.w;
  if (sun_visibility > 0.0) radiance += sun_visibility * sunlight(s, diffuse, reflectance);
  return min(radiance, vec3(65000.0));  // half floats end there
}
