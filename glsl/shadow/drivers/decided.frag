// Fills the mask with the pixels of decided tiles.
#include "shadow/drivers/gbuffer.glsl"
#include "shadow/drivers/tiles.glsl"
#include "shadow/shadowed.glsl"
#if PACKED
#include "shadow/drivers/packed.glsl"

layout(location = 0) out uvec2 texel;
layout(location = 1) out uint notes;
#else
layout(location = 0) out vec4 mask;
#endif

layout(location = 0) flat in ivec2 tile;

layout(binding = 14) uniform usampler2D decisions;
uniform int noise_free;  // 1: filters keep the pixels

bool is_lit(Decision decision, ivec2 pixel) {
  int bit = tile_size * (pixel.y % tile_size) + pixel.x % tile_size;
  return ((decision.lit[bit >> 5] >> (bit & 31)) & 1u) != 0u;
}

// A tile that is decided for every n-th pixel can't stand for those between, whose own tiles may be undecided.
const bool narrow = SCALED != 0;

Shadowed decided_shadow(Decision decision, ivec2 pixel, Receiver receiver) {
  int layer = layer_seen_through(receiver, decision.layer);
  if (is_lit(decision, pixel)) return Shadowed(Visibility(1.0, 0.0, 0.0, false, noise_free != 0), layer, narrow);
  float radius = packed_radius(receiver.position, decision.blocker_distance);
  Light light = with_layer(light_at(receiver), layer);
  bool under_texel = decision.blocker_distance > 0.0 && radius < texel_size(receiver, light);
  return Shadowed(Visibility(0.0, radius, decision.blocker_distance, under_texel, noise_free != 0), layer,
                  narrow);
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  ivec2 in_viewport = pixel - ivec2(shadow.viewport.xy);
  if (in_viewport / tile_size != tile) discard;
  Decision decision = unpacked_decision(texelFetch(decisions, tile, 0));
#if PACKED && DETAILS
  if (is_sky(pixel)) {
    texel = texel_with_depth(pack_texel(0.0, 1.0, true), pixel);
    notes = pack_notes(0, false, false, HISTORY_NONE);
    return;
  }
  Receiver receiver = receiver_at(pixel);
  uint refusal = HISTORY_NONE;
#if HISTORY
  Light light = light_at(receiver);
  light.read_radius = decision.radius;
  refusal = refusal_of(receiver, light, pixel);
#endif
  PackedPixel packed_values = packed_pixel(decided_shadow(decision, in_viewport, receiver), receiver, refusal);
  texel = texel_with_depth(packed_values.texel, pixel);
  notes = packed_values.notes;
#elif PACKED
  bool lit = is_lit(decision, in_viewport);
  uint shown = pack_texel(lit ? 0.0 : decision.blocker_distance, float(lit), true);
  texel = texel_with_depth(noise_free != 0 ? shown | noise_free_bit : shown, pixel);
  notes = pack_notes(decision.layer, false, narrow, HISTORY_NONE);
#elif DETAILS
  // Neither its normal nor its error matters here.
  Receiver receiver = make_receiver(view_position_at(pixel), vec3(0.0, 0.0, -1.0), vec2(pixel));
  mask = mask_texel(decided_shadow(decision, in_viewport, receiver));
#else
  float visibility = float(is_lit(decision, in_viewport));
  mask = vec4(stored_visibility(visibility, narrow), 0.0, 0.0, 0.0);
#endif
}
