#ifndef PENUMBRA_KERNEL_GLSL
#define PENUMBRA_KERNEL_GLSL

#include "shared/language.h"

GLSL_BEGIN

// Radius of the penumbra at a receiver, metres, of a directional light (Fernando 2005, "Percentage-closer soft
// shadows", with the light moved to infinity): depths in metres along the light.
GLSL_FUNCTION float penumbra_radius(float tan_half_angle, float receiver_depth, float blocker_depth) {
  return tan_half_angle * max(receiver_depth - blocker_depth, 0.0f);
}

// How light-space depth changes along x and y over the plane with that normal (light space, z away from the light), as
// in Isidoro 2006, "Shadow mapping: GPU-based tips and techniques". The slope is limited: planes that the light grazes
// have no finite one.
GLSL_FUNCTION vec2 plane_gradient(vec3 normal, float max_slope) {
  float facing = max(-normal.z, 1e-6f);
  vec2 gradient = vec2(normal.x, normal.y) / facing;
  float slope = length(gradient);
  return slope > max_slope ? gradient * (max_slope / slope) : gradient;
}

// Depth before which a texel blocks: the nearest of the receiver, its plane and the faces beside it (slopes towards +x,
// +y, -x, -y, not negative) at the texel's centre, less the bias.
GLSL_FUNCTION float blocking_depth(float receiver_depth, vec2 gradient, vec4 corner, vec2 offset, float bias) {
  float plane = dot(gradient, offset);
  float beside = max(corner.x * offset.x, -corner.z * offset.x) + max(corner.y * offset.y, -corner.w * offset.y);
  return receiver_depth + min(plane, -beside) - bias;
}

// Level of a pyramid (level 0: `base` metres a texel) at which a disc of that radius touches at most 2 × 2 texels.
GLSL_FUNCTION int covering_level(float radius, float base, int levels) {
  return clamp(int(ceil(log2(max(2.0f * radius / base, 1.0f)))), 0, levels - 1);
}

GLSL_END

#endif
