// Fills a level of a filtered map: means of a function of depth as filtered_of_stored() has it, 0 to 1, which the
// including file defines:
//   vec4 of_depth(float depth, int slice)
#include "shadow/light_projection.glsl"
#include "shadow/prefilter/mean.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform writeonly restrict image2DArray level;

uniform int map_layer, first_slice;  // of the shadow map; of the filtered map
uniform int block;                   // texels of the map along each side of a texel of the level

void main() {
  ivec3 at = ivec3(gl_GlobalInvocationID);
  if (any(greaterThanEqual(at.xy, imageSize(level).xy))) return;
  Light light = with_layer(frame_light(), map_layer);
  Mean mean = no_mean();
  float share = 1.0 / float(block * block);
  for (int y = 0; y < block; ++y) {
    for (int x = 0; x < block; ++x) {
      float depth = filtered_of_stored(stored_at(at.xy * block + ivec2(x, y), light));
      mean = with_value(mean, of_depth(depth, at.z), share);
    }
  }
  imageStore(level, ivec3(at.xy, first_slice + at.z), result_of(mean));
}
