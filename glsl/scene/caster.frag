// Alpha test of shadow casters, the test against a first layer of depths, and the output that marks casters that moved.
#if MASKED
#include "scene/material.glsl"

in Caster {
  vec4 uv;
  vec4 color;
} caster;
#endif

#if MARKS_MOVED
layout(location = 0) out float moved;
#endif

#if BEHIND
layout(binding = 13) uniform sampler2DArray first_layer;
uniform int map_layer;
uniform float least_gap;
#endif

void main() {
#if MASKED
  // Read before anything is discarded: mip levels need the derivatives of the whole quad.
  float alpha = base_color(caster.uv, caster.color).a;
#endif
#if BEHIND
  float first = texelFetch(first_layer, ivec3(ivec2(gl_FragCoord.xy), map_layer), 0).x;
  if (gl_FragCoord.z <= first + least_gap) discard;
#endif
#if MASKED
  if (alpha < material.alpha_cutoff) discard;
#endif
#if MARKS_MOVED
  moved = 1.0;
#endif
}
