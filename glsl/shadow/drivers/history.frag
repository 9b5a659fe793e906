#include "shadow/drivers/history.glsl"

layout(location = 0) out uvec2 texel;
layout(location = 1) out uvec2 surface;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  Kept kept = blend(pixel);
  texel = texel_with_depth(kept.texel, pixel);
  surface = kept.surface;
}
