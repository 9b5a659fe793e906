#include "shadow/drivers/history.glsl"

layout(location = 0) out uint texel;
layout(location = 1) out uvec2 surface;

void main() {
  Kept kept = blend(ivec2(gl_FragCoord.xy));
  texel = kept.texel;
  surface = kept.surface;
}
