// Incident light of every 16th pixel: its radiance divided by its albedo, so that dark materials stay dark. Each work
// group writes the sum of the logarithms over its pixels, and how many these are.
#include "render/sum_of_group.glsl"

layout(binding = 8) uniform sampler2D lit;
layout(binding = 9) uniform sampler2D gbuffer_albedo;
layout(std430, binding = 1) writeonly restrict buffer Sums { vec2 sums[]; };

// STRIDE: pixels between samples; GROUP_SAMPLES: how many of them a work group sums up.
const vec3 luminance = vec3(0.2126, 0.7152, 0.0722);

void main() {
  ivec2 size = (textureSize(lit, 0) + STRIDE - 1) / STRIDE;
  int first = int(gl_WorkGroupID.x) * GROUP_SAMPLES, end = min(first + GROUP_SAMPLES, size.x * size.y);
  vec2 sum = vec2(0.0);
  for (int i = first + int(gl_LocalInvocationIndex); i < end; i += group_size) {
    ivec2 pixel = ivec2(i % size.x, i / size.x) * STRIDE;
    vec4 root = texelFetch(gbuffer_albedo, pixel, 0);
    if (root.a < 0.5) continue;  // sky, or an unlit surface, whose colour says nothing of the light
    float albedo = max(dot(root.rgb * root.rgb, luminance), 0.05);
    sum += vec2(log2(clamp(dot(texelFetch(lit, pixel, 0).rgb, luminance) / albedo, 1e-3, 1e2)), 1.0);
  }
  sum = sum_of_group(sum);
  if (gl_LocalInvocationIndex == 0u) sums[gl_WorkGroupID.x] = sum;
}
