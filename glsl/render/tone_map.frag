#include "lib/tone_map.glsl"

layout(binding = 8) uniform sampler2D lit;
layout(binding = 9) uniform sampler2D noise;  // repeats
uniform float dither;  // width of the noise, steps of 8 bits; 0: none
layout(std430, binding = 0) readonly restrict buffer Exposure { float exposure; };

layout(location = 0) out vec4 display;

void main() {
  vec3 c = tone_map(texelFetch(lit, ivec2(gl_FragCoord.xy), 0).rgb * exposure);
  vec3 encoded = vec3(srgb_encode(c.r), srgb_encode(c.g), srgb_encode(c.b));
  // Rounding that depends on noise: over an area the mean is right, where the next step of 8 bits would show as a band.
  // What lies on a step stays there. Grey stays grey, as all channels get the same.
  ivec2 pixel = ivec2(gl_FragCoord.xy) % textureSize(noise, 0);
  float shift = dither * (texelFetch(noise, pixel, 0).r - 0.5) / 255.0;
  display = vec4(encoded + shift, 1.0);
}
