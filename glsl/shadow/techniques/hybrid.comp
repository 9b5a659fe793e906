// Finds the pixels whose shadow the map decides; all others are left to rays.
#include "shadow/decide.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, r8ui) uniform writeonly restrict uimage2D verdicts;

int verdict_of(ivec2 pixel) {
  if (is_sky(pixel)) return lit;
  Receiver receiver = receiver_at(pixel);
  Light light = frame_light();
  // Near the horizon of the surface, a part of the light may be above it.
  float cosine = light_cosine(receiver);
  float horizon = 1.5 / cone_slope(receiver, light);
  if (cosine <= -horizon) return faces_away;
  if (cosine <= horizon) return undecided;
  float radius = search_radius(receiver, light);
  LayerChoice choice = choose_layer(receiver, radius, light);
  if (choice.outside) return undecided;
  light = with_layer(light, choice.layer);
  if (!edges_are_clear(receiver, radius, vec2(0.0), light)) return undecided;
  return decide_receiver(receiver, light).kind;
}

void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(at, ivec2(shadow.viewport.zw)))) return;
  ivec2 pixel = ivec2(shadow.viewport.xy) + at;
  imageStore(verdicts, pixel, uvec4(verdict_of(pixel)));
}
