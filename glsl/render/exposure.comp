// Automatic exposure: the geometric mean of what the picture shows of the scene, brought to middle grey within limits. One
// group sums in a fixed order, so that one picture gives one exposure.
layout(local_size_x = 256) in;

layout(binding = 8) uniform sampler2D lit;
layout(binding = 12) uniform sampler2D gbuffer_depth;
layout(std430, binding = 0) writeonly restrict buffer Exposure { float exposure; };

uniform vec2 limits;   // of the exposure
uniform float target_luminance;
uniform float factor;  // compensation

shared float sums[256];
shared float counts[256];

const int stride = 4;  // pixels between samples

void main() {
  ivec2 size = (textureSize(lit, 0) + stride - 1) / stride;
  uint lane = gl_LocalInvocationIndex;
  float sum = 0.0, count = 0.0;
  for (int i = int(lane); i < size.x * size.y; i += 256) {
    ivec2 pixel = ivec2(i % size.x, i / size.x) * stride;
    if (texelFetch(gbuffer_depth, pixel, 0).x == 0.0) continue;
    float luminance = dot(texelFetch(lit, pixel, 0).rgb, vec3(0.2126, 0.7152, 0.0722));
    sum += log2(clamp(luminance, 1e-3, 1e2));
    count += 1.0;
  }
  sums[lane] = sum;
  counts[lane] = count;
  barrier();
  for (uint step = 128u; step > 0u; step >>= 1) {
    if (lane < step) {
      sums[lane] += sums[lane + step];
      counts[lane] += counts[lane + step];
    }
    barrier();
  }
  if (lane != 0u) return;
  float mean = counts[0] > 0.0 ? exp2(sums[0] / counts[0]) : target_luminance;
  exposure = factor * clamp(target_luminance / mean, limits.x, limits.y);
}
