// Percentage-closer filtering over a disc of constant radius in metres.
#include "shadow/sampling.glsl"

float read_radius(Receiver receiver, Light light) { return pcf_radius; }

Visibility visibility(Receiver receiver, Light light) {
  float bias = depth_bias(receiver, light);
  receiver = with_surroundings(receiver, bias, max_plane_slope, light);
  Scramble scramble = filter_scramble(receiver);
  float lit = 0.0;
  int i = 0;
  do {
    lit += lit_share(receiver, pcf_radius * filter_point(i, scramble, light), bias, light);
  } while (++i < pcf_filter_taps);
  lit /= float(pcf_filter_taps);
  return Visibility(lit, lit < 1.0 ? pcf_radius : 0.0, 0.0, pcf_radius < texel_size(receiver, light), false);
}
