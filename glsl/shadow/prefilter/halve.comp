// Computes a level of a filtered map from 2 × 2 texels of the finer level.
#if LOG_SPACE
#include "shadow/prefilter/esm_factor.glsl"
#endif
#include "shadow/prefilter/mean.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 8) uniform sampler2DArray source;
layout(binding = 0) uniform writeonly restrict image2DArray level;

uniform int finer_level, first_slice;

void main() {
  ivec3 at = ivec3(gl_GlobalInvocationID);
  if (any(greaterThanEqual(at.xy, imageSize(level).xy))) return;
  at.z += first_slice;
  Mean mean = no_mean();
  for (int i = 0; i < 4; ++i) {
    mean = with_value(mean, texelFetch(source, ivec3(2 * at.xy + ivec2(i & 1, i >> 1), at.z), finer_level), 0.25);
  }
  imageStore(level, at, result_of(mean));
}
