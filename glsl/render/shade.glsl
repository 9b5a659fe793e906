// Metallic-roughness shading as in glTF 2.0, appendix B: direct light, and ambient light.
// LAMPS: 1 where there are lamps besides suns.
#include "lib/brdf.glsl"
#include "render/sky.glsl"

struct Shading {
  vec3 position;  // world, metres; read only where there are lamps
  vec3 albedo;
  vec3 normal;  // unit, world
  vec3 to_eye;  // unit, world
  vec3 emission;
  float metallic;
  float roughness;
  float occlusion;
};

// The reflectance of a surface.
struct Reflection {
  vec3 diffuse;    // albedo of the diffuse part
  vec3 at_normal;  // specular reflectance at normal incidence (F0)
};

Reflection reflection_of(Shading s) {
  return Reflection(s.albedo * (1.0 - s.metallic), mix(vec3(0.04), s.albedo, s.metallic));
}

// A light as it reaches a point.
struct Incident {
  vec3 to_light;     // unit, world
  vec3 illuminance;  // on a plane perpendicular to that
};

#if LAMPS

// KHR_lights_punctual: inverse square, a window that ends at the range, and a spot's cone.
Incident incident_at(vec3 position, DirectLightBlock light) {
  if (light.least_square == 0.0) return Incident(light.place, light.illuminance);
  vec3 to_lamp = light.place - position;
  float square = dot(to_lamp, to_lamp);
  vec3 to_light = to_lamp * inversesqrt(max(square, 1e-12));
  float of_range = square * light.inverse_range * light.inverse_range;
  float window = clamp(1.0 - of_range * of_range, 0.0, 1.0);
  float cone = clamp(-dot(light.axis, to_light) * light.cone_scale + light.cone_offset, 0.0, 1.0);
  return Incident(to_light, light.illuminance * (window * cone * cone / max(square, light.least_square)));
}
#else
Incident incident_at(vec3 position, DirectLightBlock light) { return Incident(light.place, light.illuminance); }
#endif

// Reflected radiance of an unshadowed light. Without branches, which would hardly ever skip work for a whole group of
// pixels.
vec3 direct_light(Shading s, Reflection r, Incident light) {
  float n_dot_l = max(dot(s.normal, light.to_light), 0.0);
  vec3 half_vector = light.to_light + s.to_eye;
  half_vector *= inversesqrt(max(dot(half_vector, half_vector), 1e-12));  // 0 where the eye looks into the light
  float n_dot_v = max(dot(s.normal, s.to_eye), 1e-4);
  // Lights are not points: with less roughness than this, a highlight would be smaller than the light's mirror image.
  float alpha = max(s.roughness * s.roughness, 0.005);
  vec3 fresnel = mix(r.at_normal, vec3(1.0), schlick_weight(dot(s.to_eye, half_vector)));
  float lobe = ggx_distribution(clamp(dot(s.normal, half_vector), 0.0, 1.0), alpha) *
               smith_visibility(n_dot_l, n_dot_v, alpha);
  vec3 brdf = (1.0 - fresnel) * r.diffuse / brdf_pi + fresnel * lobe;
  return light.illuminance * n_dot_l * brdf;
}

// `mirrored`: the radiance of the surroundings in the mirror's direction, blurred by the roughness.
vec3 skylight(Shading s, Reflection r, vec3 mirrored) {
  float n_dot_v = clamp(dot(s.normal, s.to_eye), 0.0, 1.0);
  vec2 scale_bias = environment_brdf(s.roughness, n_dot_v);
  vec3 all_around = ambient(s.normal);
  mirrored = mix(mirrored, all_around, s.roughness);
  return s.occlusion * (r.diffuse * all_around + (r.at_normal * scale_bias.x + scale_bias.y) * mirrored);
}

// Radiance that does not depend on shadows: ambient light and emission.
vec3 unshadowed_light(Shading s, Reflection r, vec3 mirrored) {
  return skylight(s, r, mirrored) + s.emission * lighting.emission;
}

// Adds a light that is visible to the given degree, 0 to 1.
void add_light(inout vec3 radiance, Shading s, Reflection r, int index, float visibility) {
  radiance += visibility * direct_light(s, r, incident_at(s.position, lighting.lights[index]));
}

// The largest half float: pictures are stored as half floats.
vec3 storable(vec3 radiance) { return min(radiance, vec3(65000.0)); }
