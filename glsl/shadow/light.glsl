// The light's maps and what every technique does with them: choose a cascade, compare texels with a receiver.
#include "shared/shadow_block.h"
#include "lib/hash.glsl"
#include "lib/disc.glsl"
#include "lib/kernel.glsl"

layout(std140, binding = 1) uniform ShadowData { ShadowBlock shadow; };
layout(std140, binding = 2) uniform SampleData { SampleBlock samples; };

layout(binding = 0) uniform sampler2DArray shadow_depth;    // light-space depth, linear, one layer a cascade
layout(binding = 1) uniform sampler2DArray shadow_pyramid;  // minimum over 4 · 2^level texels squared

layout(binding = 4) uniform sampler2D sample_noise;        // two values a pixel; repeats; a power of two wide and high

// A point to be shaded, in light space (metres, origin in the camera).
struct Receiver {
  vec3 position;
  vec3 normal;    // geometric
  vec2 gradient;  // of its plane: change of depth per metre across the light
  Corner corner;  // the faces beside it
  vec2 pixel;     // seeds the noise
  bool renewed;   // there is a history, and it was refused here: more taps are worth it
};

struct Light {
  float tan_half_angle;
  bool square;
  int cascades;
  int cascade;  // the one to read
  float reach;  // metres: what the technique said it reads
};

struct Visibility {
  float visibility;        // 1 lit, 0 in shadow
  float penumbra_radius;   // metres; 0 where there is no blocker
  float blocker_distance;  // mean, along the light, metres; 0 where there is no blocker
  bool under_texel;        // the kernel is smaller than a texel of the map
};

const float max_plane_slope = 1000.0;

Visibility fully_lit() { return Visibility(1.0, 0.0, 0.0, false); }

Light frame_light() { return Light(shadow.light.x, shadow.light.y != 0.0, int(shadow.light.z), 0, 0.0); }

float texel_size(Light light) { return shadow.cascades[light.cascade].map.w; }

// A receiver as the cascade's bias rules move it: along its normal by a part of a texel's shadow on it.
Receiver offset_receiver(Receiver receiver, Light light) {
  float sine = sqrt(max(1.0 - receiver.normal.z * receiver.normal.z, 0.0));
  receiver.position += receiver.normal * (bias_normal_offset * texel_size(light) * sine);
  return receiver;
}

// Bias along the light, metres: what rounding needs, and a part of the texel's depth range on the receiver's plane.
float depth_bias(Receiver receiver, Light light) {
  return shadow.cascades[light.cascade].depth.z +
         texel_size(light) * (bias_constant + bias_slope * length(receiver.gradient));
}

// Largest distance from the cascade's centre along either axis, in half widths of its map; over 1 is outside.
float cascade_edge(int cascade, vec3 position, float radius) {
  vec4 map = shadow.cascades[cascade].map;
  vec4 depth = shadow.cascades[cascade].depth;
  vec2 d = abs(position.xy - map.xy);
  float inside = 2.0 * map.z * (max(d.x, d.y) + radius + 1.5 * map.w);
  return position.z - depth.x > depth.y * 1.0001 ? 2.0 : inside;
}

// The finest cascade that holds the whole disc; the last one holds what no other does.
int finest_cascade(Light light, vec3 position, float radius) {
  int cascade = 0;
  while (cascade < light.cascades - 1 && cascade_edge(cascade, position, radius) > 1.0) ++cascade;
  return cascade;
}

// Four texels about a point of the map, their light-space depths, and where they lie.
struct Footprint {
  vec4 depths;   // metres; order of textureGather: (0,1) (1,1) (1,0) (0,0)
  vec2 corner;   // centre of texel (0,0) relative to the receiver, metres
  vec2 weight;   // bilinear, of the texels with the higher coordinate
};

Footprint fetch_footprint(vec3 position, vec2 offset, Light light) {
  CascadeBlock cascade = shadow.cascades[light.cascade];
  vec2 at = ((position.xy + offset - cascade.map.xy) * cascade.map.z + 0.5) * shadow.light.w - 0.5;
  vec2 first = floor(at);
  vec4 stored = textureGather(shadow_depth, vec3((first + 1.0) / shadow.light.w, float(light.cascade)));
  Footprint footprint;
  footprint.depths = cascade.depth.x + cascade.depth.y * stored;
  footprint.weight = at - first;
  footprint.corner = offset - footprint.weight * cascade.map.w;
  return footprint;
}

float depth_at(ivec2 texel, Light light) {
  CascadeBlock cascade = shadow.cascades[light.cascade];
  ivec2 within = clamp(texel, ivec2(0), ivec2(shadow.light.w) - 1);
  return cascade.depth.x + cascade.depth.y * texelFetch(shadow_depth, ivec3(within, light.cascade), 0).x;
}

// How much nearer to the light the surface beside the receiver gets with each metre towards one side. 0 unless the next
// three texels rise, not less and less, as a face or the foot of one does, and their surface, continued to the
// receiver, passes behind it.
float side_slope(Receiver receiver, ivec2 at, ivec2 side, float texels, float bias, Light light) {
  float first = depth_at(at + side, light);
  float second = depth_at(at + 2 * side, light);
  float near = first - second;
  float far = second - depth_at(at + 3 * side, light);
  float rise = min(near, far);
  bool goes_on = rise > 0.0 && near <= 1.25 * far + bias;
  bool behind = first + rise * texels >= receiver.position.z - bias;
  return goes_on && behind ? rise / texel_size(light) : 0.0;
}

// Where lit faces meet in a corner each lies before the other's plane, and yet neither hides the other: a receiver next
// to another face must not be shadowed by what lies on that face's plane either. What rises by more than `steepest`
// metres with each metre blocks all the same.
Receiver receiver_in_corner(Receiver receiver, float bias, float steepest, Light light) {
  CascadeBlock cascade = shadow.cascades[light.cascade];
  vec2 place = ((receiver.position.xy - cascade.map.xy) * cascade.map.z + 0.5) * shadow.light.w;
  ivec2 at = ivec2(floor(place));
  vec2 high = vec2(at) + 1.5 - place;
  vec2 low = place - vec2(at) + 0.5;
  vec4 own = max(vec4(-receiver.gradient, receiver.gradient), 0.0);
  vec4 slopes = vec4(side_slope(receiver, at, ivec2(1, 0), high.x, bias, light),
                     side_slope(receiver, at, ivec2(0, 1), high.y, bias, light),
                     side_slope(receiver, at, ivec2(-1, 0), low.x, bias, light),
                     side_slope(receiver, at, ivec2(0, -1), low.y, bias, light));
  bool meets = any(greaterThan(slopes, own * 1.01 + bias / texel_size(light)));
  receiver.corner = Corner(meets ? max(slopes, own) : vec4(0.0), steepest);
  return receiver;
}

// Offsets of a footprint's texels from the receiver, metres.
struct Offsets {
  vec4 x, y;
};

Offsets texel_offsets(Footprint footprint, float texel) {
  vec2 low = footprint.corner;
  vec2 high = footprint.corner + texel;
  return Offsets(vec4(low.x, high.x, high.x, low.x), vec4(high.y, high.y, low.y, low.y));
}

// 1 for each texel of a footprint that blocks, else 0.
vec4 blocking_texels(Receiver receiver, Footprint footprint, float bias, Light light) {
  Offsets offsets = texel_offsets(footprint, texel_size(light));
  return vec4(lessThan(footprint.depths, blocking_depths(receiver.position.z, receiver.gradient, receiver.corner,
                                                         offsets.x, offsets.y, bias)));
}

float bilinear(vec4 texels, vec2 weight) {
  vec2 rows = mix(texels.wx, texels.zy, weight.x);
  return mix(rows.x, rows.y, weight.y);
}

// Share of light that passes a point of the map: percentage-closer filtering of the four texels about it (Reeves et al.
// 1987, "Rendering antialiased shadows with depth maps").
float lit_share(Receiver receiver, vec2 offset, float bias, Light light) {
  Footprint footprint = fetch_footprint(receiver.position, offset, light);
  return 1.0 - bilinear(blocking_texels(receiver, footprint, bias, light), footprint.weight);
}

// Points of the light's shape, -1..1, from the tables. A disc's points are rotated, or like a square's shifted on the
// torus and then mapped.
struct Scramble {
  vec2 value;  // rotation: cosine, sine; shift: of the unit square
};

vec2 shape_point(vec4 table, int index, Scramble scramble, Light light) {
  vec2 point = (index & 1) == 0 ? table.xy : table.zw;
#if SAMPLE_ROTATE
  return vec2(point.x * scramble.value.x - point.y * scramble.value.y,
              point.x * scramble.value.y + point.y * scramble.value.x);
#else
  vec2 shifted = toroidal_shift(point, scramble.value);
  return light.square ? 2.0 * shifted - 1.0 : concentric_disc(shifted);
#endif
}

const int blocker_step = 0;
const int filter_step = 1;

// By the tile of noise, each step from another part of it.
Scramble scramble_of(Receiver receiver, int step) {
  ivec2 mask = textureSize(sample_noise, 0) - 1;
  ivec2 at = ivec2(receiver.pixel) + (mask + 1) / 2 * step;
  vec2 noise = toroidal_shift(texelFetch(sample_noise, at & mask, 0).xy,
                              step == blocker_step ? shadow.noise_shift.xy : shadow.noise_shift.zw);
#if SAMPLE_ROTATE
  float angle = 6.2831853 * noise.x;
  return Scramble(vec2(cos(angle), sin(angle)));
#else
  return Scramble(noise);
#endif
}

vec2 blocker_point(int index, Scramble scramble, Light light) {
  return shape_point(samples.blocker[index >> 1], index, scramble, light);
}

vec2 filter_point(int index, Scramble scramble, Light light) {
  return shape_point(samples.filter_points[index >> 1], index, scramble, light);
}

// Instead of those, where the history is refused.
vec2 renewal_point(int index, Scramble scramble, Light light) {
  return shape_point(samples.renewal_points[index >> 1], index, scramble, light);
}
