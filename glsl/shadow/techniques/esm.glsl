// Exponential shadow maps (Annen et al. 2008): where nothing of the kernel lies behind the receiver, the depth test is
// nearly exp(c · (z - d)), whose mean is exp(-c · d) times a mean that does not depend on the receiver.
#include "shadow/prefiltered.glsl"
#include "shadow/greatest_depth.glsl"
#include "shadow/sampling.glsl"

layout(binding = UNIT_esm_depths) uniform sampler2DArray esm_depths;

const float greatest_power = 60.0;  // a sum of a few exponentials of it stays finite

float read_radius(Receiver receiver, Light light) { return filter_reach(receiver, esm_radius); }

// Bilinear, of exponentials of four texels relative to the receiver's, so that none overflows.
float exponential_at(vec2 at, int level, float depth, Light light) {
  ivec2 last = last_of_level(esm_depths, level);
  at = at * vec2(last + 1) - 0.5;
  ivec2 low = clamp(ivec2(floor(at)), ivec2(0), last), high = clamp(ivec2(floor(at)) + 1, ivec2(0), last);
  vec4 logarithms = vec4(texelFetch(esm_depths, ivec3(low.x, high.y, light.layer), level).x,
                         texelFetch(esm_depths, ivec3(high, light.layer), level).x,
                         texelFetch(esm_depths, ivec3(high.x, low.y, light.layer), level).x,
                         texelFetch(esm_depths, ivec3(low, light.layer), level).x);
  return bilinear(exp(min(esm_exponent * (logarithms - depth), greatest_power)), fract(at));
}

float filtered_exponential(FilteredPlace place, float depth, Light light) {
  // A sun's kernel is the same in every level; a lamp's lies between those of two.
  float at = texels_vary() ? place.level : floor(place.level + 0.5);
  int level = int(at);
  float coarser = at - float(level);
  float sum = 0.0;
  int i = 0;
  do {
    vec2 point = place.first + float(i) * place.next;
    sum += (1.0 - coarser) * exponential_at(point, level, depth, light);
    if (coarser > 0.0) sum += coarser * exponential_at(point, level + 1, depth, light);
  } while (++i < place.points);
  return sum / float(place.points);
}

float compared_share(Receiver receiver, Light light) {
  float bias = depth_bias(receiver, light);
  Scramble scramble = filter_scramble(receiver);
  float lit = 0.0;
  int i = 0;
  do {
    lit += lit_share(receiver, esm_radius * filter_point(i, scramble, light), bias, light);
  } while (++i < esm_fallback_taps);
  return lit / float(esm_fallback_taps);
}

// Whether a part of the kernel may lie behind the receiver's plane, by more than what makes the result too great by the
// threshold. The bound is over all texels that the kernel averages and the interpolation reads, each at most as wide as
// a quarter of the radius or one texel of level 0; so on a plane that faces the light no failure is missed.
bool may_lie_before_depths(Receiver receiver, Light light) {
  float radius = light.read_radius;
  float deepest = receiver.position.z + radius * length(receiver.gradient);
  float reach = radius + 1.5 * max(0.25 * radius, float(esm_shrink) * texel_size(receiver, light));
  float behind = filtered_of(greatest_near(receiver.position, reach, light), light) - filtered_of(deepest, light);
  return behind > log(1.0 + esm_threshold) / esm_exponent;
}

bool fails(float lit, Receiver receiver, Light light) {
  if (esm_classification == esm_classification_none) return false;
  if (esm_classification == esm_classification_threshold) return lit > 1.0 + esm_threshold;
  return may_lie_before_depths(receiver, light);
}

Visibility visibility(Receiver receiver, Light light) {
  FilteredPlace place = filtered_place(esm_depths, receiver, esm_radius, esm_shrink, light);
  float depth = filtered_of(receiver.position.z - depth_bias(receiver, light), light);
  float lit = filtered_exponential(place, depth, light);
  if (fails(lit, receiver, light)) lit = compared_share(receiver, light);
  return of_constant_kernel(min(lit, 1.0), esm_radius, receiver, light);
}
