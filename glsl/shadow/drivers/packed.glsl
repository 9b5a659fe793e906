// Writes a pixel of a mask for a denoiser: its packed texel, and whether its history is valid.
#include "shadow/shadowed.glsl"
#include "lib/packed_texel.glsl"
#if HISTORY
#include "shadow/history.glsl"
#include "shadow/movement.glsl"
#endif

struct PackedPixel {
  uint texel;  // written as texel_with_depth()
  uint notes;
};

PackedPixel packed_pixel(Shadowed shadowed, Receiver receiver, uint refusal) {
  Visibility seen = shadowed.visibility;
  // Filters derive kernel sizes from the distance, so it is computed from the radius, which some techniques give alone.
  // Under a light that is hardly wider than a point, packed_distance() would take the radius for a nearer blocker's.
  bool from_radius = !is_light_narrow() || seen.blocker_distance <= 0.0;
  float distance_to =
      from_radius ? packed_distance(receiver.position, seen.penumbra_radius) : seen.blocker_distance;
  uint texel = pack_texel(distance_to, seen.visibility, refusal != HISTORY_KEPT);
  return PackedPixel(seen.noise_free ? texel | noise_free_bit : texel,
                     pack_notes(shadowed.layer, seen.under_texel, shadowed.narrow, refusal));
}

#if HISTORY

// Looks in the finest layer that contains the disc, since coarser layers may miss casters thinner than a texel.
bool movement_within(Receiver receiver, float radius, Light light) {
  light = with_layer(light, finest_layer(receiver, radius, light));
  return movement_seen(receiver.position, radius + 1.5 * texel_size(receiver, light), light);
}

// Whether something moved that blocks, or blocked, a part of the light. The technique's read radius depends on this
// frame's casters only; one that has disappeared may have been nearer to the light.
bool caster_moved(Receiver receiver, Light light) {
  float of_moved = penumbra_radius(receiver, most_moved_distance(receiver), light);
  return movement_within(receiver, light.read_radius, light) ||
         movement_within(receiver, max(light.read_radius, of_moved), light);
}

uint refusal_of(Receiver receiver, Light light, ivec2 pixel) {
  uint refusal = reproject(receiver, pixel).refusal;
  bool asks = refusal == HISTORY_KEPT && shadow.casters_moved != 0 && faces_light(receiver);
  return asks && caster_moved(receiver, light) ? HISTORY_CASTER_MOVED : refusal;
}
#endif
