#ifndef PENUMBRA_KERNEL_GLSL
#define PENUMBRA_KERNEL_GLSL

#include "shared/language.h"

GLSL_BEGIN

// Radius of the penumbra at a receiver, metres, of a directional light (Fernando 2005, "Percentage-closer soft
// shadows", with the light moved to infinity) and a blocker at that distance from it along the light, metres.
GLSL_FUNCTION float sun_penumbra_radius(float tan_half_angle, float blocker_distance) {
  return tan_half_angle * max(blocker_distance, 0.0f);
}

// Gradient of light-space depth along x and y on the plane with that normal (light space, z away from the light), as in
// Isidoro 2006, "Shadow mapping: GPU-based tips and techniques". The slope is clamped, because it is infinite for
// planes parallel to the light.
GLSL_FUNCTION vec2 plane_gradient(vec3 normal, float max_slope) {
  float facing = max(-normal.z, 1e-6f);
  vec2 gradient = vec2(normal.x, normal.y) / facing;
  float slope = length(gradient);
  return slope > max_slope ? gradient * (max_slope / slope) : gradient;
}

// The same for a lamp at the origin and a receiver at that position, in the projective space in which its rays are
// parallel to z and the receiver keeps its place (light_projection.glsl): x and y are scaled by the receiver's depth
// over their own.
GLSL_FUNCTION vec2 lamp_plane_gradient(vec3 normal, vec3 position, float max_slope) {
  float facing = max(-dot(normal, position), 1e-6f * position.z);
  vec2 gradient = vec2(normal.x, normal.y) * (position.z / facing);
  float slope = length(gradient);
  return slope > max_slope ? gradient * (max_slope / slope) : gradient;
}

// The surroundings of a receiver as the shadow map shows them. Heights are above the receiver's plane, metres along the
// light.
struct Surroundings {
  vec4 slopes;       // of lit faces beside it: how much higher they get per metre towards +x, +y, -x, -y; not negative
  float steepest;    // what rises towards the light by more than this per metre blocks even if it lies on those faces
  float covered;     // metres; not 0 if something covers the receiver: texels so near block wherever before the plane
  float unresolved;  // what is not higher than this is no blocker: it may be the receiver's own surface
};

// Depths below which four texels are blockers: the least depth of the receiver, its plane and the faces beside it at
// the texels' centres, minus the bias. `plane`: how much deeper than the receiver its plane lies there, metres.
GLSL_FUNCTION vec4 blocking_depths(float receiver_depth, vec4 plane, Surroundings about, vec4 x, vec4 y, float bias) {
  vec4 distance_to = max(abs(x), abs(y));
  vec4 faces = max(about.slopes.x * x, -about.slopes.z * x) + max(about.slopes.y * y, -about.slopes.w * y);
  vec4 before_faces = max(plane - faces, min(plane, -about.steepest * distance_to));
  vec4 before_receiver = max(plane, vec4(0.0f)) * step(distance_to, vec4(about.covered));
  return receiver_depth + min(before_faces, before_receiver) - (bias + about.unresolved);
}

// 1 for each texel that can block a part of the light, else 0: those at most `radius` from the receiver, which is the
// radius of the light's cone at the texel's depth plus the extent of a texel.
GLSL_FUNCTION vec4 within_cone(vec4 radius, bool square, vec4 x, vec4 y) {
  vec4 beyond = square ? max(abs(x), abs(y)) - radius : x * x + y * y - radius * radius;
  return step(beyond, vec4(0.0f));
}

// Level of a pyramid (level 0: `base` metres a texel) at which a disc of that radius touches at most 2 × 2 texels.
GLSL_FUNCTION int covering_level(float radius, float base, int levels) {
  // The exponent of the least power of two that is not less: faster than a logarithm, and exact.
  uint bits = floatBitsToUint(max(2.0f * radius / base, 1.0f));
  return clamp(int((bits + 0x7fffffu) >> 23) - 127, 0, levels - 1);
}

GLSL_END

#endif
