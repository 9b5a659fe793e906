// Computes a receiver's visibility: chooses the layer of the shadow map, calls the technique, blends between layers.
// Included after a technique, which defines
//   float read_radius(Receiver, Light)      radius in metres of the disc that visibility() will read
//   Visibility visibility(Receiver, Light)  with light.layer chosen, if it needs any texture of the light
#include "shadow/shadowed.glsl"

// The frame's light, with the read radius of the technique for a receiver.
Light light_for(Receiver receiver) {
  Light light = frame_light();
  if (faces_light(receiver)) light.read_radius = read_radius(receiver, light);
  return light;
}

Shadowed shadow_of(Receiver receiver, Light light) {
  if (!faces_light(receiver)) return Shadowed(Visibility(0.0, 0.0, 0.0, false), 0);
#if CHOOSES_LAYER
  LayerChoice choice = choose_layer(receiver, light.read_radius, light);
  if (choice.outside) return Shadowed(fully_lit(), choice.layer);
  int first = choice.layer;
  float fade = choice.fade;
  if (cascades_seam == cascades_seam_dither) {
    first += white_noise(uvec2(receiver.pixel), 977u).x < fade ? 1 : 0;
    fade = 0.0;
  }
  Visibility mixed = Visibility(0.0, 0.0, 0.0, false);
  int last = fade > 0.0 ? first + 1 : first;
  for (int layer = first; layer <= last; ++layer) {
    light = with_layer(light, layer);
    float weight = layer == first ? 1.0 - fade : fade;
    Visibility one = visibility(offset_receiver(receiver, light), light);
    mixed.visibility += weight * one.visibility;
    mixed.penumbra_radius += weight * one.penumbra_radius;
    mixed.blocker_distance += weight * one.blocker_distance;
    mixed.under_texel = mixed.under_texel || one.under_texel;
  }
  return Shadowed(mixed, first);
#else
  return Shadowed(visibility(receiver, light), 0);
#endif
}
