// Alpha test of shadow casters, and the output that marks casters that moved.
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

void main() {
#if MASKED
  if (base_color(caster.uv, caster.color).a < material.alpha_cutoff) discard;
#endif
#if MARKS_MOVED
  moved = 1.0;
#endif
}
