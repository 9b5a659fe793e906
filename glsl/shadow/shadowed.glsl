// A receiver's visibility, and the layer of the shadow map from which it was computed.
#include "shadow/light.glsl"
#include "lib/packed_texel.glsl"

#ifndef SCALED
#define SCALED 0  // 1: the pixels are every n-th of a mask, and stand for those between
#endif

struct Shadowed {
  Visibility visibility;
  int layer;
  bool narrow;  // the pixel can't stand for those around it; never if SCALED is 0
};

// Whether the light shines on the receiver unless something blocks it.
bool faces_light(Receiver receiver) { return light_cosine(receiver) > 0.0 && shines_at(receiver); }

// Whether a shadow of that penumbra radius, metres, may change from a receiver's pixel to the next: on the surface, it
// is shorter than what the pixel shows in the direction in which the camera sees the surface foreshortened.
bool is_narrow(Receiver receiver, float radius) {
#if SCALED
  vec3 position = view_position_of(receiver);
  vec3 view_ray = shadow.clip_to_view[2].xyz - position * shadow.clip_to_view[2].w;
  float foreshortening = abs(dot(view_normal_of(receiver), view_ray)) / length(view_ray);
  return radius * foreshortening < pixel_width(position);
#else
  return false;
#endif
}

// See Mask in the library's headers.
vec4 mask_texel(Shadowed shadowed) {
  Visibility seen = shadowed.visibility;
  return vec4(stored_visibility(seen.visibility, shadowed.narrow), seen.penumbra_radius, seen.blocker_distance,
              float(shadowed.layer) + (seen.under_texel ? 0.5 : 0.0));
}
