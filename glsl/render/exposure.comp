// Automatic exposure: the geometric mean of the light that exposure_sums.comp has summed up. One work group adds its
// sums in a fixed order, so that the result is deterministic.
#include "render/sum_of_group.glsl"

layout(std430, binding = 0) writeonly restrict buffer Exposure { float exposure; };
layout(std430, binding = 1) readonly restrict buffer Sums { vec2 sums[]; };

uniform int groups;    // that have written sums
uniform vec2 limits;   // of the exposure, lowest and highest
uniform float white;   // value of a white surface in the mean light
uniform float factor;  // exposure compensation

void main() {
  vec2 sum = vec2(0.0);
  for (int i = int(gl_LocalInvocationIndex); i < groups; i += group_size) sum += sums[i];
  sum = sum_of_group(sum);
  if (gl_LocalInvocationIndex != 0u) return;
  float mean = sum.y > 0.0 ? exp2(sum.x / sum.y) : white;
  exposure = factor * clamp(white / mean, limits.x, limits.y);
}
