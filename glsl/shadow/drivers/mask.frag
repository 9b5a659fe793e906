#include "shadow/drivers/mask.glsl"

layout(location = 0) out vec4 mask;

void main() { mask = shade_pixel(ivec2(gl_FragCoord.xy)); }
