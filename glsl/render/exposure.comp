// Automatic exposure from incident light: the geometric mean of each pixel's radiance divided by its albedo, so that
// dark materials stay dark. A single work group sums in a fixed order, so that the result is deterministic.
layout(local_size_x = 256) in;

layout(binding = 8) uniform sampler2D lit;
layout(binding = 9) uniform sampler2D gbuffer_albedo;
layout(std430, binding = 0) writeonly restrict buffer Exposure { float exposure; };

uniform vec2 limits;   // of the exposure, lowest and highest
uniform float white;   // value of a white surface in the mean light
uniform float factor;  // exposure compensation

shared float sums[256];
shared float counts[256];

const int stride = 4;  // pixels between samples
const vec3 luminance = vec3(0.2126, 0.7152, 0.0722);

void main() {
  ivec2 size = (textureSize(lit, 0) + stride - 1) / stride;
  uint lane = gl_LocalInvocationIndex;
  float sum = 0.0, count = 0.0;
  for (int i = int(lane); i < size.x * size.y; i += 256) {
    ivec2 pixel = ivec2(i % size.x, i / size.x) * stride;
    vec4 root = texelFetch(gbuffer_albedo, pixel, 0);
    if (root.a == 0.0) continue;  // sky
    float albedo = max(dot(root.rgb * root.rgb, luminance), 0.05);
    sum += log2(clamp(dot(texelFetch(lit, pixel, 0).rgb, luminance) / albedo, 1e-3, 1e2));
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
  float mean = counts[0] > 0.0 ? exp2(sums[0] / counts[0]) : white;
  exposure = factor * clamp(white / mean, limits.x, limits.y);
}
