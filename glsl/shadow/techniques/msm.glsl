// Moment shadow maps (Peters and Klein 2015): of all distributions of depth with the four moments of the kernel, none
// has a greater share behind the receiver than this bound.
#include "shadow/prefiltered.glsl"

layout(binding = UNIT_msm_moments) uniform sampler2DArray msm_moments;

float read_radius(Receiver receiver, Light light) { return filter_reach(receiver, msm_radius); }

// Mixed with those of depths that are spread evenly over the range, so that rounding leaves them moments of a
// distribution.
vec4 biased(vec4 moments) {
  bool rounded = msm_format == msm_format_unorm16;
  return mix(moments, vec4(0.0, 1.0 / 3.0, 0.0, 1.0 / 5.0), rounded ? max(msm_moment_bias, 6e-5) : msm_moment_bias);
}

// With four moments a plane's depths under the kernel look like three points, of which the nearest lies √3 standard
// deviations before their mean: a receiver there is wholly lit.
Visibility visibility(Receiver receiver, Light light) {
  FilteredPlace place = filtered_place(msm_moments, receiver, msm_radius, msm_shrink, light);
  vec4 moments = filtered_texel(msm_moments, place, 0, 1, light);
  if (msm_format == msm_format_unorm16) moments = unpacked_moments(moments);
  float bias = depth_bias(receiver, light) + msm_plane_bias * plane_deviation(receiver, light);
  float depth = filtered_of(receiver.position.z - bias, light);
  float lit = without_bleeding(hamburger_bound(2.0 * depth - 1.0, biased(moments)), msm_bleeding);
  return of_constant_kernel(lit, msm_radius, receiver, light);
}
