// Adds a sample of each pixel to the mean of all: as it is displayed, and as linear light.
#include "lib/tone_map.glsl"

layout(binding = 8) uniform sampler2D lit;
layout(std430, binding = 0) readonly restrict buffer Exposure { float exposure; };
uniform float share;  // of the sample in the mean

layout(location = 0) out vec4 display;
layout(location = 1) out vec4 color;

void main() {
  vec3 light = texelFetch(lit, ivec2(gl_FragCoord.xy), 0).rgb;
  display = vec4(tone_map(light * exposure), 1.0) * share;
  color = vec4(light, 1.0) * share;
}
