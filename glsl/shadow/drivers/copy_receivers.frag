// Copies a texture of receivers from a layer of an array, or from one of the samples of each pixel.
#if SAMPLES && ARRAY
layout(binding = 8) uniform sampler2DMSArray source;
#elif SAMPLES
layout(binding = 8) uniform sampler2DMS source;
#else
layout(binding = 8) uniform sampler2DArray source;
#endif
uniform int layer;
uniform int sample_number;

layout(location = 0) out vec4 copied;

vec4 source_at(ivec2 pixel) {
#if SAMPLES && ARRAY
  return texelFetch(source, ivec3(pixel, layer), sample_number);
#elif SAMPLES
  return texelFetch(source, pixel, sample_number);
#else
  return texelFetch(source, ivec3(pixel, layer), 0);
#endif
}

void main() { copied = source_at(ivec2(gl_FragCoord.xy)); }
