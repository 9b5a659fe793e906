// Percentage-closer filtering at the points of a Poisson disc, each compared and filtered by the texture unit.
#include "shadow/sampling.glsl"

layout(binding = UNIT_compared_depth) uniform sampler2DArrayShadow compared_depth;

float read_radius(Receiver receiver, Light light) { return pcf_poisson_radius; }

Visibility visibility(Receiver receiver, Light light) {
  float bias = depth_bias(receiver, light);
  Scramble scramble = filter_scramble(receiver);
  float lit = 0.0;
  int i = 0;
  do {
    vec2 offset = pcf_poisson_radius * filter_point(i, scramble, light);
    lit += compared_share(compared_depth, receiver, offset, bias, light);
  } while (++i < pcf_poisson_taps);
  lit /= float(pcf_poisson_taps);
  bool under_texel = pcf_poisson_radius < texel_size(receiver, light);
  return Visibility(lit, lit < 1.0 ? pcf_poisson_radius : 0.0, 0.0, under_texel, false);
}
