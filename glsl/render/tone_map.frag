#include "render/encode.glsl"

layout(binding = 8) uniform sampler2D lit;
layout(std430, binding = 0) readonly restrict buffer Exposure { float exposure; };

layout(location = 0) out vec4 display;

void main() { display = encoded(tone_map(texelFetch(lit, ivec2(gl_FragCoord.xy), 0).rgb * exposure)); }
