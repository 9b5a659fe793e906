// Metallic-roughness shading as in glTF 2.0, appendix B: direct light, and ambient light.
// LAMPS: 1 where there are lamps besides suns.
#include "lib/brdf.glsl"
#include "render/sky.glsl"

struct Shading {
  vec3 position;  // world, metres; read only where there are lamps
  vec3 albedo;
  vec3 normal;  // unit, world
  float smooth_lean;  // see src/scene/smooth_lean.h
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

// The share of a light that is left where the smooth normal turns towards it by that cosine. Up to a cosine of
// smooth_lean a triangle may face away from the light and lie in its own shadow, so light fades in from there on, and
// the edge of that shadow is dark on both sides.
float terminator_share(Shading s, float n_dot_l) {
  float lean = lighting.soft_terminator * s.smooth_lean;
  return smoothstep(lean, 1.5 * lean + 1e-6, n_dot_l);
}

// Reflected radiance of an unshadowed light. Without branches, which would hardly ever skip work for a whole group of
// pixels.
vec3 direct_light(Shading s, Reflection r, Incident light) {
  float n_dot_l = dot(s.normal, light.to_light), n_dot_v = dot(s.normal, s.to_eye);
  // The half vector is l + v over its length, the root of 2 + 2 l·v; 0 where the eye looks into the light.
  float l_dot_v = dot(light.to_light, s.to_eye);
  float inverse_length = inversesqrt(max(2.0 + 2.0 * l_dot_v, 1e-12));
  float n_dot_h = clamp((n_dot_l + n_dot_v) * inverse_length, 0.0, 1.0);
  float v_dot_h = (1.0 + l_dot_v) * inverse_length;
  n_dot_l = max(n_dot_l, 0.0);
  n_dot_v = max(n_dot_v, 1e-4);
  // Lights are not points: with less roughness than this, a highlight would be smaller than the light's mirror image.
  float alpha = max(s.roughness * s.roughness, 0.005);
  vec3 fresnel = mix(r.at_normal, vec3(1.0), schlick_weight(v_dot_h));
  float lobe = ggx_distribution(n_dot_h, alpha) * smith_visibility(n_dot_l, n_dot_v, alpha);
  vec3 brdf = (1.0 - fresnel) * r.diffuse * (1.0 / brdf_pi) + fresnel * lobe;
  return light.illuminance * (n_dot_l * terminator_share(s, n_dot_l)) * brdf;
}

vec3 skylight(Shading s, Reflection r, AmbientLight ambient) {
  float n_dot_v = clamp(dot(s.normal, s.to_eye), 0.0, 1.0);
  vec2 scale_bias = environment_brdf(s.roughness, n_dot_v);
  vec3 all_around = irradiance(ambient, s.normal);
  vec3 mirrored = mirrored_light(ambient, reflect(-s.to_eye, s.normal), s.roughness);
  mirrored = mix(mirrored, all_around, s.roughness);
  return s.occlusion * (r.diffuse * all_around + (r.at_normal * scale_bias.x + scale_bias.y) * mirrored);
}

// Radiance that does not depend on shadows: ambient light and emission.
vec3 unshadowed_light(Shading s, Reflection r, AmbientLight ambient) {
  return skylight(s, r, ambient) + s.emission * lighting.emission;
}

// Adds a light that is visible to the given degree, 0 to 1.
void add_light(inout vec3 radiance, Shading s, Reflection r, int index, float visibility) {
  radiance += visibility * direct_light(s, r, incident_at(s.position, lighting.lights[index]));
}

// The largest half float: pictures are stored as half floats.
vec3 storable(vec3 radiance) { return min(radiance, vec3(65000.0)); }
