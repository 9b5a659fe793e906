// Computes a receiver's visibility: chooses the layer of the shadow map, calls the technique, blends between layers.
// Included after a technique, which defines
//   float read_radius(Receiver, Light)      radius in metres of the disc that visibility() will read
//   Visibility visibility(Receiver, Light)  with light.layer chosen, if it needs any texture of the light
#include "shadow/shadowed.glsl"

// The frame's light, with the read radius of the technique for a receiver.
Light light_for(Receiver receiver) {
  Light light = light_at(receiver);
  if (faces_light(receiver)) light.read_radius = read_radius(receiver, light);
  return light;
}

// The same for one of its layers; a lamp's faces see a receiver differently.
Light light_for_layer(Receiver seen, Light light, int layer) {
  if (is_lamp && layer != light.layer) {
    light = light_at(seen);
    light.layer = layer;
    light.read_radius = read_radius(seen, light);
  }
  return with_layer(light, layer);
}

Shadowed shadow_of(Receiver receiver, Light light) {
  if (!faces_light(receiver)) return Shadowed(Visibility(0.0, 0.0, 0.0, false, false), 0, SCALED != 0);
#if CHOOSES_LAYER
  LayerChoice choice = choose_layer(receiver, light.read_radius, light);
  if (choice.outside) return Shadowed(fully_lit(), choice.layer, false);
  float reach = light.read_radius;
  int first = choice.layer;
  vec2 fades = choice.fades;
  bool dithers = cascades_seam == cascades_seam_dither && fades.x > 0.0;
  if (cascades_seam == cascades_seam_dither) {
    float noise = white_noise(uvec2(receiver.pixel), 977u).x;
    first = noise < fades.x ? choice.others.x : noise < fades.x + fades.y ? choice.others.y : first;
    fades = vec2(0.0);
  }
  Visibility mixed = Visibility(0.0, 0.0, 0.0, false, !dithers);
  int readings = fades.y > 0.0 ? 3 : fades.x > 0.0 ? 2 : 1;
  int i = 0;
  do {
    int layer = i == 0 ? first : i == 1 ? choice.others.x : choice.others.y;
    Receiver seen = seen_by_layer(receiver, layer);
    light = light_for_layer(seen, light, layer);
    float weight = i == 0 ? 1.0 - fades.x - fades.y : i == 1 ? fades.x : fades.y;
    Visibility one = visibility(offset_receiver(seen, light), light);
    mixed.visibility += weight * one.visibility;
    mixed.penumbra_radius += weight * one.penumbra_radius;
    mixed.blocker_distance += weight * metres_to_blocker(seen, one.blocker_distance);
    mixed.under_texel = mixed.under_texel || one.under_texel;
    mixed.noise_free = mixed.noise_free && one.noise_free;
  } while (++i < readings);
  return Shadowed(mixed, first, is_narrow(receiver, mixed.penumbra_radius > 0.0 ? mixed.penumbra_radius : reach));
#else
  return Shadowed(visibility(receiver, light), 0, false);
#endif
}
