#include "lib/tone_map.glsl"

layout(binding = 8) uniform sampler2D lit;
layout(std430, binding = 0) readonly restrict buffer Exposure { float exposure; };

layout(location = 0) out vec4 display;

void main() {
  vec3 c = tone_map(texelFetch(lit, ivec2(gl_FragCoord.xy), 0).rgb * exposure);
  display = vec4(srgb_encode(c.r), srgb_encode(c.g), srgb_encode(c.b), 1.0);
}
