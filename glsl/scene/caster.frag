#include "scene/material.glsl"

in Caster {
  vec4 uv;
  vec4 color;
} caster;

void main() {
  if (base_color(caster.uv, caster.color).a < material.alpha_cutoff) discard;
}
