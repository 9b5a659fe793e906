// Writes the mask of receivers in shadow, at pixels whose stencil counts a volume.
#include "shadow/drivers/gbuffer.glsl"

layout(location = 0) out vec4 mask;

void main() {
  if (is_sky(ivec2(gl_FragCoord.xy))) discard;
  mask = vec4(0.0);
}
