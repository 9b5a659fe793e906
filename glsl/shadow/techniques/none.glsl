// No shadows: every receiver is lit.
#include "shadow/light.glsl"

float read_radius(Receiver receiver, Light light) { return 0.0; }

Visibility visibility(Receiver receiver, Light light) { return fully_lit(); }
