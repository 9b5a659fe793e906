// The shadow of the light's centre, compared and filtered by the texture unit.
#include "shadow/light.glsl"

layout(binding = UNIT_compared_depth) uniform sampler2DArrayShadow compared_depth;

float read_radius(Receiver receiver, Light light) { return 0.0; }

Visibility visibility(Receiver receiver, Light light) {
  float lit = compared_share(compared_depth, receiver, vec2(0.0), depth_bias(receiver, light), light);
  return Visibility(lit, 0.0, 0.0, true, false);
}
