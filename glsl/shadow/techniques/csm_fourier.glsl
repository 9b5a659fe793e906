// Convolution shadow maps (Annen et al. 2007): the depth test is a step, 1 where the depth z in the map is not less
// than the receiver's depth d. Its Fourier series
//   1/2 + Σ 2 / (π n) · sin(n ω (z - d)), n = 1, 3, 5, …
// splits into functions of z, whose means the product has, and functions of d.
#include "shadow/prefiltered.glsl"
#include "lib/fourier.glsl"

layout(binding = UNIT_fourier_terms) uniform sampler2DArray fourier_terms;

float read_radius(Receiver receiver, Light light) { return filter_reach(receiver, csm_fourier_radius); }

float sine_of_difference(vec2 cosine_and_sine, float angle) {
  return cosine_and_sine.y * cos(angle) - cosine_and_sine.x * sin(angle);
}

Visibility visibility(Receiver receiver, Light light) {
  const int slices = (csm_fourier_terms + 1) / 2;
  FilteredPlace place = filtered_place(fourier_terms, receiver, csm_fourier_radius, csm_fourier_shrink, light);
  float depth = filtered_of(receiver.position.z - depth_bias(receiver, light), light);
  float sum = 0.5;
  for (int slice = 0; slice < slices; ++slice) {
    vec4 means = filtered_texel(fourier_terms, place, slice, slices, light);
    int term = 2 * slice;
    sum += fourier_weight(term, csm_fourier_terms, csm_fourier_attenuation) *
           sine_of_difference(means.xy, fourier_frequency(term, csm_fourier_terms) * depth);
    if (++term == csm_fourier_terms) break;
    sum += fourier_weight(term, csm_fourier_terms, csm_fourier_attenuation) *
           sine_of_difference(means.zw, fourier_frequency(term, csm_fourier_terms) * depth);
  }
  // A receiver lies on the step itself where it is lit, at which the series is 1/2: twice the sum makes that 1.
  return of_constant_kernel(clamp(2.0 * sum, 0.0, 1.0), csm_fourier_radius, receiver, light);
}
