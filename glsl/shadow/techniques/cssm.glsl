// Convolution soft shadow maps (Annen et al. 2008): blocker search and filter of percentage-closer soft shadows, by
// means over squares from the levels of a map of Fourier terms, which cost the same at every size.
#include "shadow/search.glsl"
#include "shadow/prefiltered.glsl"
#include "lib/fourier.glsl"

layout(binding = UNIT_cssm_terms) uniform sampler2DArray cssm_waves;

float read_radius(Receiver receiver, Light light) { return search_radius(receiver, light); }

// Places of a square of so many metres to each side of the receiver: four points, at the level whose texels are half as
// wide as the square.
struct Square {
  vec2 at, apart;  // texture coordinates: the middle, and from it to the points
  float level;
};

Square square_around(Receiver receiver, float radius, Light light) {
  float side = float(textureSize(cssm_waves, 0).x * cssm_shrink);
  vec2 texels = radius / texel_extent(receiver, light);
  float level = log2(max(max(texels.x, texels.y) / float(cssm_shrink), 1.0));
  level = min(level, float(textureQueryLevels(cssm_waves) - 1));
  return Square(map_place(receiver.position, light) / side, 0.5 * texels / side, level);
}

vec4 mean_over(Square square, int slice, Light light) {
  const int slices = (cssm_terms + 1) / 2 * 2;
  slice += light.layer * slices;
  int level = int(square.level);
  int coarser = min(level + 1, textureQueryLevels(cssm_waves) - 1);
  vec4 sum = vec4(0.0);
  for (int i = 0; i < 4; ++i) {
    vec2 at = square.at + square.apart * vec2(i % 2 == 0 ? -1.0 : 1.0, i < 2 ? -1.0 : 1.0);
    sum += mix(level_texel(cssm_waves, at, slice, level), level_texel(cssm_waves, at, slice, coarser),
               square.level - float(level));
  }
  return 0.25 * sum;
}

// Mean over the square of a step that is 1/2 for depths before the receiver's and -1/2 for depths behind it, or of that
// times the depth.
float mean_step(Square square, bool times_depth, float depth, Light light) {
  const int half_of_slices = (cssm_terms + 1) / 2;
  float sum = 0.0;
  for (int slice = 0; slice < half_of_slices; ++slice) {
    vec4 means = mean_over(square, times_depth ? half_of_slices + slice : slice, light);
    for (int i = 0; i < 2; ++i) {
      int term = 2 * slice + i;
      if (term >= cssm_terms) break;
      vec2 wave = i == 0 ? means.xy : means.zw;
      float angle = fourier_frequency(term, cssm_terms) * depth;
      sum -= fourier_weight(term, cssm_terms, cssm_attenuation) * (wave.y * cos(angle) - wave.x * sin(angle));
    }
  }
  return sum;
}

// Twice the step: what lies in the receiver's own plane is on it, where it is 0 and counts as lit.
float blocked_share(Square square, float depth, Light light) {
  return clamp(2.0 * mean_step(square, false, depth, light), 0.0, 1.0);
}

const float least_share = 1.0 / 512.0;  // what ringing and the terms' rounding leave of no blocker

Visibility visibility(Receiver receiver, Light light) {
  float bias = depth_bias(receiver, light);
  Search search = narrow_search(receiver, light, light.read_radius);
  if (search.nearest >= receiver.position.z - bias) return fully_lit();
  float depth = stored_of(receiver.position.z - bias, light);
  Square around = square_around(receiver, search.radius, light);
  float blocked = 2.0 * mean_step(around, false, depth, light);
  if (blocked <= least_share) return fully_lit();
  float blocker = clamp(2.0 * mean_step(around, true, depth, light) / blocked, 0.0, depth);
  float mean = receiver.position.z - max(stored_depth(blocker, light), search.nearest);
  float radius = penumbra_radius(receiver, mean, light);
  Square kernel = square_around(receiver, square_half(radius, light), light);
  float lit = 1.0 - blocked_share(kernel, depth, light);
  return Visibility(lit, radius, mean, radius < texel_size(receiver, light), false);
}
