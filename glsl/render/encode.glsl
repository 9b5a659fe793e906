#include "lib/tone_map.glsl"

layout(binding = 9) uniform sampler2D noise;  // repeats; a power of two wide and as high
uniform float dither;                         // width of the noise, steps of 8 bits; 0: none

// A linear colour of the display as a pixel of 8 bits, sRGB-encoded.
vec4 encoded(vec3 c) {
  vec3 srgb = vec3(srgb_encode(c.r), srgb_encode(c.g), srgb_encode(c.b));
  // Rounding that depends on noise: over an area the mean is right, where the next step of 8 bits would show as a band.
  // What lies on a step stays there. Grey stays grey, as all channels get the same. GPUs may round by a tenth of a step
  // more or less, so the shader leaves them nothing to round.
  ivec2 pixel = ivec2(gl_FragCoord.xy) & (textureSize(noise, 0) - 1);
  float up = 0.5 + dither * (texelFetch(noise, pixel, 0).r - 0.5);
  return vec4(floor(255.0 * srgb + up) / 255.0, 1.0);
}
