// What a receiver sees of the light, and by which layer of its map.
#include "shadow/light.glsl"

struct Shadowed {
  Visibility visibility;
  int layer;
};

bool faces_light(Receiver receiver) { return light_cosine(receiver) > 0.0; }
