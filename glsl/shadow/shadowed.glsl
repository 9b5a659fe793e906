// A receiver's visibility, and the layer of the shadow map from which it was computed.
#include "shadow/light.glsl"

struct Shadowed {
  Visibility visibility;
  int layer;
};

bool faces_light(Receiver receiver) { return light_cosine(receiver) > 0.0; }
