// The shadow of the light's centre, filtered over the map's texel.
#include "shadow/light.glsl"

float read_radius(Receiver receiver, Light light) { return 0.0; }

Visibility visibility(Receiver receiver, Light light) {
  float bias = depth_bias(receiver, light);
  float lit = lit_share(receiver, vec2(0.0), bias, light);
  if (lit < 1.0) {
    lit = lit_share(with_surroundings(receiver, bias, max_plane_slope, light), vec2(0.0), bias, light);
  }
  return Visibility(lit, 0.0, 0.0, true, false);
}
