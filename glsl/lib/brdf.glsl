#ifndef PENUMBRA_BRDF_GLSL
#define PENUMBRA_BRDF_GLSL

#include "shared/language.h"

GLSL_BEGIN

const float brdf_pi = 3.14159265f;

// Share of facets that face the half vector (Walter et al. 2007, "Microfacet models for refraction"): GGX; alpha is
// roughness squared. Written so that it stays accurate where the lobe is narrow.
GLSL_FUNCTION float ggx_distribution(float n_dot_h, float alpha) {
  float a2 = alpha * alpha;
  float f = (n_dot_h * a2 - n_dot_h) * n_dot_h + 1.0f;
  return a2 / (brdf_pi * f * f);
}

// Masking and shadowing over 4 (n·l)(n·v), height-correlated (Heitz 2014, "Understanding the masking-shadowing
// function").
GLSL_FUNCTION float smith_visibility(float n_dot_l, float n_dot_v, float alpha) {
  float a2 = alpha * alpha;
  float to_light = n_dot_v * sqrt(n_dot_l * n_dot_l * (1.0f - a2) + a2);
  float to_eye = n_dot_l * sqrt(n_dot_v * n_dot_v * (1.0f - a2) + a2);
  return 0.5f / max(to_light + to_eye, 1e-7f);
}

// Schlick 1994, "An inexpensive BRDF model for physically-based rendering".
GLSL_FUNCTION float schlick_weight(float v_dot_h) {
  float m = clamp(1.0f - v_dot_h, 0.0f, 1.0f);
  float m2 = m * m;
  return m2 * m2 * m;
}

// Scale and bias of the reflectance at normal incidence for light from all around (Karis 2014, "Physically based
// shading on mobile", after Lazarov).
GLSL_FUNCTION vec2 environment_brdf(float roughness, float n_dot_v) {
  vec4 r = vec4(1.0f - roughness, 0.0425f - 0.0275f * roughness, 1.04f - 0.572f * roughness,
                -0.04f + 0.022f * roughness);
  float a = min(r.x * r.x, exp2(-9.28f * n_dot_v)) * r.x + r.y;
  return vec2(-1.04f * a + r.z, 1.04f * a + r.w);
}

GLSL_END

#endif
