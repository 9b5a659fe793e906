// Computes one level of the depth pyramid, from 2 × 2 texels of the finer level.
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, rg32f) uniform readonly restrict image2DArray source;
layout(binding = 1, rg32f) uniform writeonly restrict image2DArray level;

void main() {
  ivec3 at = ivec3(gl_GlobalInvocationID);
  if (any(greaterThanEqual(at.xy, imageSize(level).xy))) return;
  ivec3 low = ivec3(at.xy * 2, at.z);
  vec2 a = imageLoad(source, low).xy, b = imageLoad(source, low + ivec3(1, 0, 0)).xy;
  vec2 c = imageLoad(source, low + ivec3(0, 1, 0)).xy, d = imageLoad(source, low + ivec3(1, 1, 0)).xy;
  imageStore(level, at, vec4(min(min(a, b), min(c, d)), 0.0, 0.0));
}
