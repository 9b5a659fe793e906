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
uniform float gap;
layout(location = 0) out float depth;
#endif

void main() {
#if MASKED
  // Read before anything is discarded: mip levels need the derivatives of the whole quad.
  float alpha = base_color(caster.uv, caster.color).a;
#endif
#if MASKED
  if (alpha < material.alpha_cutoff) discard;
#endif
#if MARKS_MOVED
  moved = 1.0;
#endif
#if BEHIND
  depth = gl_FragCoord.z + gap;
#endif
}
