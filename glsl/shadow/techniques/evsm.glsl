// Exponential variance shadow maps (Lauritzen and McCool 2008): Chebyshev's bounds for two warps of depth, of which the
// lesser holds.
#include "shadow/prefiltered.glsl"
#include "shadow/prefilter/evsm_warp.glsl"

layout(binding = UNIT_evsm_moments) uniform sampler2DArray evsm_moments;

float read_radius(Receiver receiver, Light light) { return filter_reach(receiver, evsm_radius); }

// `slope`: of the warp at the receiver, which turns a deviation of depth into one of the warp.
float bound_of(vec2 moments, float warped, float slope, float deviation) {
  float least = slope * deviation;
  float variance = max(moments.y - moments.x * moments.x, least * least);
  return without_bleeding(chebyshev_bound(warped, moments.x, variance), evsm_bleeding);
}

Visibility visibility(Receiver receiver, Light light) {
  FilteredPlace place = filtered_place(evsm_moments, receiver, evsm_radius, evsm_shrink, light);
  vec4 moments = filtered_texel(evsm_moments, place, 0, 1, light);
  float bias = depth_bias(receiver, light) + evsm_plane_bias * plane_deviation(receiver, light);
  float depth = clamp(filtered_of(receiver.position.z - bias, light), 0.0, 1.0);
  vec2 warped = warped_depth(depth);
  vec2 slopes = abs(warped) * warp_exponents();
  float deviation = 2.0 * filtered_difference(evsm_least_deviation, light);
  float lit = bound_of(moments.xy, warped.x, slopes.x, deviation);
  if (evsm_warps == 2) lit = min(lit, bound_of(moments.zw, warped.y, slopes.y, deviation));
  return of_constant_kernel(lit, evsm_radius, receiver, light);
}
