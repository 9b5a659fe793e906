// A receiver's visibility, and the layer of the shadow map from which it was computed.
#include "shadow/light.glsl"

struct Shadowed {
  Visibility visibility;
  int layer;
};

// Whether the light shines on the receiver unless something blocks it.
bool faces_light(Receiver receiver) { return light_cosine(receiver) > 0.0 && shines_at(receiver); }

// See Mask in the library's headers.
vec4 mask_texel(Shadowed shadowed) {
  return vec4(shadowed.visibility.visibility, shadowed.visibility.penumbra_radius, shadowed.visibility.blocker_distance,
              float(shadowed.layer) + (shadowed.visibility.under_texel ? 0.5 : 0.0));
}
