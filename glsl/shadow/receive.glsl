// From a receiver to its visibility: choose the cascade, ask the technique, fade across cascades. Included after a
// technique, which defines
//   float reach(Receiver, Light)            radius in metres of the disc that visibility() will read
//   Visibility visibility(Receiver, Light)  with light.cascade chosen
struct Shadowed {
  Visibility visibility;
  int cascade;
};

bool faces_light(Receiver receiver) { return receiver.normal.z < 0.0; }

// The light of the frame, with what the technique will read of it for a receiver.
Light light_for(Receiver receiver) {
  Light light = frame_light();
  if (faces_light(receiver)) light.reach = reach(receiver, light);
  return light;
}

Shadowed shadow_of(Receiver receiver, Light light) {
  if (!faces_light(receiver)) return Shadowed(Visibility(0.0, 0.0, 0.0, false), 0);
  int cascade = finest_cascade(light, receiver.position, light.reach);
  float edge = cascade_edge(cascade, receiver.position, light.reach);
  if (cascade == light.cascades - 1 && cascade_edge(cascade, receiver.position, 0.0) > 1.0) {
    return Shadowed(fully_lit(), cascade);
  }
  bool fades = cascades_seam != cascades_seam_none && cascade < light.cascades - 1;
  float fade = fades ? clamp((edge - 1.0) / cascades_blend + 1.0, 0.0, 1.0) : 0.0;
  if (cascades_seam == cascades_seam_dither) {
    cascade += white_noise(uvec2(receiver.pixel), 977u).x < fade ? 1 : 0;
    fade = 0.0;
  }
  Visibility mixed = Visibility(0.0, 0.0, 0.0, false);
  int last = fade > 0.0 ? cascade + 1 : cascade;
  for (light.cascade = cascade; light.cascade <= last; ++light.cascade) {
    float weight = light.cascade == cascade ? 1.0 - fade : fade;
    Visibility one = visibility(offset_receiver(receiver, light), light);
    mixed.visibility += weight * one.visibility;
    mixed.penumbra_radius += weight * one.penumbra_radius;
    mixed.blocker_distance += weight * one.blocker_distance;
    mixed.under_texel = mixed.under_texel || one.under_texel;
  }
  return Shadowed(mixed, cascade);
}

vec4 mask_texel(Shadowed shadowed) {
  return vec4(shadowed.visibility.visibility, shadowed.visibility.penumbra_radius, shadowed.visibility.blocker_distance,
              float(shadowed.cascade) + (shadowed.visibility.under_texel ? 0.5 : 0.0));
}
