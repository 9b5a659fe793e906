// A pixel of a mask that goes through history and filters: what it holds, and whether its history holds.
#include "shadow/receive.glsl"
#include "lib/packed_texel.glsl"
#if HISTORY
#include "shadow/history.glsl"
#include "shadow/movement.glsl"
#endif

struct PackedPixel {
  uint texel;
  uint notes;
};

PackedPixel packed_pixel(Shadowed shadowed, uint refusal) {
  Visibility seen = shadowed.visibility;
  // Kernels take their size from the distance, also those of techniques that give the size alone.
  float distance_to = seen.penumbra_radius / packed_slope(shadow.light.x);
  return PackedPixel(pack_texel(distance_to, seen.visibility, refusal != HISTORY_KEPT),
                     pack_notes(shadowed.cascade, seen.under_texel, refusal));
}

#if HISTORY

// In the finest map that holds the disc: what is thinner than a texel of a coarser one may be missing there.
bool movement_within(vec3 position, float radius, Light light) {
  int cascade = finest_cascade(light, position, radius);
  return movement_seen(position, radius + 1.5 * shadow.cascades[cascade].map.w, cascade);
}

// Whether something moved that hides, or hid, a part of the light. The technique's reach follows from the casters of
// this frame; one that has left may have stood higher.
bool caster_moved(Receiver receiver, Light light) {
  float all = max(light.reach, penumbra_radius(light.tan_half_angle, receiver.position.z, shadow.history.w));
  return movement_within(receiver.position, light.reach, light) || movement_within(receiver.position, all, light);
}

uint refusal_of(Receiver receiver, Light light, ivec2 pixel) {
  uint refusal = reproject(receiver, pixel).refusal;
  bool asks = refusal == HISTORY_KEPT && shadow.history.z != 0.0 && faces_light(receiver);
  return asks && caster_moved(receiver, light) ? HISTORY_CASTER_MOVED : refusal;
}
#endif
