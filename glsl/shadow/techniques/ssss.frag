#include "shadow/techniques/ssss_soften.glsl"

layout(location = 0) out vec4 mask;

void main() { mask = soft_pixel(ivec2(gl_FragCoord.xy)); }
