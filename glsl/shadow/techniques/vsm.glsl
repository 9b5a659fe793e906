// Variance shadow maps (Donnelly and Lauritzen 2006): of all distributions of depth with the kernel's mean and
// variance, none has a greater share behind the receiver than Chebyshev's bound.
#include "shadow/prefiltered.glsl"

layout(binding = UNIT_vsm_moments) uniform sampler2DArray vsm_moments;

float read_radius(Receiver receiver, Light light) { return filter_reach(receiver, vsm_radius); }

Visibility visibility(Receiver receiver, Light light) {
  FilteredPlace place = filtered_place(vsm_moments, receiver, vsm_radius, vsm_shrink, light);
  vec2 moments = filtered_texel(vsm_moments, place, 0, 1, light).xy;
  float depth = filtered_of(receiver.position.z - depth_bias(receiver, light), light) - 0.5;
  float deviation = filtered_difference(vsm_least_deviation, light);
  float variance = max(moments.y - moments.x * moments.x, deviation * deviation);
  float lit = without_bleeding(chebyshev_bound(depth, moments.x, variance), vsm_bleeding);
  return of_constant_kernel(lit, vsm_radius, receiver, light);
}
