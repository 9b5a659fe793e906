// Helpers for sample points. The library generates the functions that return the points, one pair for each of a
// technique's sample sets, and includes them before its file: for a set "blocker"
//   vec2 blocker_point(int index, Scramble scramble, Light light)
//   Scramble blocker_scramble(Receiver receiver)
#include "shadow/light.glsl"

layout(binding = 1) uniform sampler2D sample_noise;  // two values a pixel; repeats; a power of two wide and high

// Points of the light's shape, -1..1, from the tables. Points on a disc are either rotated, or shifted toroidally in
// the unit square like a square's and then mapped to the disc.
struct Scramble {
  vec2 value;  // rotation: cosine, sine; shift: of the unit square
};

// Points are rotated for discs alone.
bool is_square(Light light) {
#if SAMPLE_ROTATE
  return false;
#else
  return light.square;
#endif
}

vec2 shape_point(vec2 point, Scramble scramble, Light light) {
#if SAMPLE_ROTATE
  return vec2(point.x * scramble.value.x - point.y * scramble.value.y,
              point.x * scramble.value.y + point.y * scramble.value.x);
#else
  vec2 shifted = toroidal_shift(point, scramble.value);
  return is_square(light) ? 2.0 * shifted - 1.0 : concentric_disc(shifted);
#endif
}

const int blocker_step = 0;
const int filter_step = 1;

// Two values, 0..1, of the frame's noise texture; each step reads a different part of it.
vec2 pixel_noise(Receiver receiver, int step) {
  ivec2 mask = textureSize(sample_noise, 0) - 1;
  ivec2 at = ivec2(receiver.pixel) + (mask + 1) / 2 * step;
  return toroidal_shift(texelFetch(sample_noise, at & mask, 0).xy,
                        step == blocker_step ? shadow.noise_shift.xy : shadow.noise_shift.zw);
}

Scramble scramble_of(Receiver receiver, int step) {
  vec2 noise = pixel_noise(receiver, step);
#if SAMPLE_ROTATE
  float angle = 6.2831853 * noise.x;
  return Scramble(vec2(cos(angle), sin(angle)));
#else
  return Scramble(noise);
#endif
}
