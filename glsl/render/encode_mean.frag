#include "render/encode.glsl"

layout(binding = 8) uniform sampler2D mean;  // linear, of the display

layout(location = 0) out vec4 display;

void main() { display = encoded(texelFetch(mean, ivec2(gl_FragCoord.xy), 0).rgb); }
