#include "shadow/drivers/mask.glsl"

#if PACKED
layout(location = 0) out uint texel;
layout(location = 1) out uint notes;

void main() {
  PackedPixel shaded = shade_pixel(ivec2(gl_FragCoord.xy));
  texel = shaded.texel;
  notes = shaded.notes;
}
#else
layout(location = 0) out vec4 mask;

void main() { mask = shade_pixel(ivec2(gl_FragCoord.xy)); }
#endif
