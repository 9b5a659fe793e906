// Helpers for sample points. The library generates the functions that return the points, one pair for each of a
// technique's sample sets, and includes them before its file: for a set "blocker"
//   vec2 blocker_point(int index, Scramble scramble, Light light)
//   Scramble blocker_scramble(Receiver receiver)
#include "shadow/light.glsl"

// Steps of low-discrepancy sequences: the golden ratio's, and for pairs the plastic number's (Roberts 2018).
const float golden = 0.61803399;
const vec2 plastic = vec2(0.75487767, 0.56984029);

// Frames one above another, each a power of two wide and as high; repeats. xy: two values; zw: a key (see Scramble),
// where there are any.
layout(binding = 1) uniform sampler2D sample_noise;

// Values of SAMPLE_SCRAMBLE: how points of the light's shape, -1..1, from the tables differ from pixel to pixel.
#define SCRAMBLE_ROTATE 0  // a disc's points are rotated
#define SCRAMBLE_SHIFT 1   // points are shifted toroidally in the unit square, and then mapped to the shape
#define SCRAMBLE_KEYS 2    // points of a grid of 256 x 256 cells get other digits and another order
#define SCRAMBLE_NONE 3    // the program reads no points

struct Scramble {
#if SAMPLE_SCRAMBLE == SCRAMBLE_KEYS
  uvec2 digits;  // point XOR digits
  int order;     // index XOR order
  int frame;     // each frame's samples follow those of the last one
#else
  vec2 value;  // rotation: cosine, sine; shift: of the unit square
#endif
};

#if SAMPLE_SCRAMBLE == SCRAMBLE_KEYS
// The point that a frame of `count` samples takes as number `index`.
int keyed_index(int index, int count, Scramble scramble) {
  return ((scramble.frame * count + index) & 255) ^ scramble.order;
}
#endif

// Points are rotated for discs alone.
bool is_square(Light light) {
#if SAMPLE_SCRAMBLE == SCRAMBLE_ROTATE
  return false;
#else
  return light.square;
#endif
}

vec2 shape_point(vec2 point, Scramble scramble, Light light) {
#if SAMPLE_SCRAMBLE == SCRAMBLE_ROTATE
  vec2 turned = vec2(point.x * scramble.value.x - point.y * scramble.value.y,
                     point.x * scramble.value.y + point.y * scramble.value.x);
  return on_outline(turned, light);
#else
#if SAMPLE_SCRAMBLE == SCRAMBLE_KEYS
  vec2 in_square = (vec2(uvec2(point) ^ scramble.digits) + 0.5) / 256.0;
#else
  vec2 in_square = toroidal_shift(point, scramble.value);
#endif
  return on_outline(is_square(light) ? 2.0 * in_square - 1.0 : concentric_disc(in_square), light);
#endif
}

const int blocker_step = 0;
const int filter_step = 1;

// The texel of the noise texture that a step reads; each step reads a different part of it.
vec4 noise_texel(Receiver receiver, int step) {
  ivec4 place = shadow.noise_place[step];
  int side = textureSize(sample_noise, 0).x;
  ivec2 at = (ivec2(receiver.pixel) + place.xy) & (side - 1);
  return texelFetch(sample_noise, at + ivec2(0, side * place.z), 0);
}

// Two values, 0..1.
vec2 pixel_noise(Receiver receiver, int step) {
  return toroidal_shift(noise_texel(receiver, step).xy,
                        step == blocker_step ? shadow.noise_shift.xy : shadow.noise_shift.zw);
}

#if SAMPLE_SCRAMBLE != SCRAMBLE_NONE
Scramble scramble_of(Receiver receiver, int step) {
#if SAMPLE_SCRAMBLE == SCRAMBLE_ROTATE
  float angle = 6.2831853 * pixel_noise(receiver, step).x;
  return Scramble(vec2(cos(angle), sin(angle)));
#elif SAMPLE_SCRAMBLE == SCRAMBLE_SHIFT
  return Scramble(pixel_noise(receiver, step));
#else
  uvec2 key = uvec2(noise_texel(receiver, step).zw * 65535.0 + 0.5);
  return Scramble(uvec2(key.x & 255u, key.x >> 8), int(key.y),
                  shadow.noise_place[step].w);
#endif
}
#endif
