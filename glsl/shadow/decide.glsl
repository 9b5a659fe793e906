// Decides receivers that no penumbra reaches: where the shadow map has no edge within the disc that can block light
// from a receiver, it shows one surface there, and the receiver lies either on that surface and is lit, or below it and
// is in shadow.
#ifndef LEAVES_TO_RAYS
#define LEAVES_TO_RAYS 0  // 1: what the map may show wrongly is left undecided
#endif
#include "shadow/search.glsl"
#include "shadow/projection/tiles.glsl"
#include "shadow/shadowed.glsl"
#include "shadow/drivers/gbuffer.glsl"
#if LEAVES_TO_RAYS
#include "shadow/techniques/hybrid_masked.glsl"
#endif

// Whether no edge of the map can block light from receivers within these half widths, of which this is the one that is
// farthest from the light. `radius`: bounds their discs.
bool edges_are_clear(Receiver deepest, float radius, vec2 half_widths, Light light) {
  float margin = (2.0 + bias_normal_offset) * texel_size(deepest, light);
  bool narrower = true;
  int i = 0;
  do {
    float nearest = depth_bounds(deepest.position, half_widths + radius + margin, light).edge;
    if (nearest >= deepest.position.z) {
#if LEAVES_TO_RAYS
      return masks_are_clear(deepest, radius, half_widths, light);
#else
      return true;
#endif
    }
    float needed = penumbra_radius(deepest, deepest.position.z - nearest, light);
    narrower = needed < radius;
    radius = needed;
  } while (narrower && ++i < 4);
  return false;
}

// What is known of a pixel.
const int in_shadow = 0, lit = 1, faces_away = 2, undecided = 3, unseen = 4;

struct PixelState {
  int kind;
  float blocker_distance;  // metres, of a pixel in shadow
};

// Where no edge of the map is near, the four texels around a receiver that faces the light show whether it is lit.
PixelState decide_receiver(Receiver receiver, Light light) {
  receiver = offset_receiver(receiver, light);
  Footprint footprint = fetch_footprint(receiver, vec2(0.0), light);
  vec4 heights = heights_above(receiver, footprint.depths, footprint.offsets);
  float texel = texel_size(receiver, light);
  float bias = depth_bias(receiver, light);
  float bend = unresolved_bend * texel * texel_slope(receiver, light);
  float least = min(min(heights.x, heights.y), min(heights.z, heights.w));
  float most = max(max(heights.x, heights.y), max(heights.z, heights.w));
  // As in with_surroundings(): a bend is forgiven only where a texel shows the receiver's own surface.
  if (least <= bias && most <= bias + bend) return PixelState(lit, 0.0);
  bool covered = least > bias + bend + 2.0 * texel;
  return PixelState(covered ? in_shadow : undecided,
                    metres_to_blocker(receiver, receiver.position.z - bilinear(footprint.depths, footprint.weight)));
}

// Whether the pixel faces the light, or faces away or lies where it does not shine; for rays, undecided where one part
// of the light may be above the horizon of its surface and another part below it.
int facing_of(Receiver receiver, Light light) {
  float cosine = light_cosine(receiver);
#if LEAVES_TO_RAYS
  float horizon = 1.5 / cone_slope(receiver, light);
  if (abs(cosine) < horizon) return undecided;
#endif
  return faces_light(receiver) ? lit : faces_away;
}

// As the light's layer shows it; `unseen` where other layers alone are read.
PixelState decide_pixel(ivec2 pixel, Light light) {
  if (is_sky(pixel)) return PixelState(lit, 0.0);
  Receiver receiver = receiver_at(pixel);
  int facing = facing_of(receiver, light);
  if (facing != lit) return PixelState(facing, 0.0);
  if (is_outside(receiver)) return PixelState(undecided, 0.0);
  if (!reads_layer(receiver, light)) return PixelState(unseen, 0.0);
  receiver = seen_by_layer(receiver, light.layer);
  return decide_receiver(receiver, own_light(receiver, light));
}
