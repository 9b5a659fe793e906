// What the technique ssss softens: the hard shadow, how far from each pixel its blocker is, and how far around it a
// penumbra can come from. See docs/techniques.md.
#include "shadow/search.glsl"

float read_radius(Receiver receiver, Light light) { return search_radius(receiver, light); }

// Here penumbra_radius bounds the radius of the penumbra, metres; 0: the hard shadow is exact.
Visibility visibility(Receiver receiver, Light light) {
  float bias = depth_bias(receiver, light);
  receiver = with_surroundings(receiver, bias, cone_slope(receiver, light), light);
  Visibility seen = centre_shadow(receiver, bias, light);
  float radius = edge_radius(receiver, light);
  seen.penumbra_radius = radius < 0.5 * texel_size(receiver, light) ? 0.0 : radius;
  return seen;
}
