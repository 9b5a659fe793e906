// Filters a level of a filtered map along one axis.
#if LOG_SPACE
#include "shadow/prefilter/esm_factor.glsl"
#endif
#include "shadow/prefilter/mean.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 8) uniform sampler2DArray source;
layout(binding = 0) uniform writeonly restrict image2DArray target;

uniform int source_level;
uniform ivec2 first_slices;  // of the source and of the target
uniform ivec2 axis;
uniform float weights[9];  // by distance from the centre, texels; 0 beyond the kernel; they add up to 1

void main() {
  ivec3 at = ivec3(gl_GlobalInvocationID);
  ivec2 last = textureSize(source, source_level).xy - 1;
  if (any(greaterThan(at.xy, last))) return;
  Mean mean = no_mean();
  for (int i = -8; i <= 8; ++i) {
    float weight = weights[abs(i)];
    if (weight == 0.0) continue;
    ivec2 from = clamp(at.xy + i * axis, ivec2(0), last);
    mean = with_value(mean, texelFetch(source, ivec3(from, first_slices.x + at.z), source_level), weight);
  }
  imageStore(target, ivec3(at.xy, first_slices.y + at.z), result_of(mean));
}
