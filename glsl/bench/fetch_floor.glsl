// Makes only the fetches of a technique that searches for blockers and filters: as many, from the same discs of the
// same map.
#include "shadow/sampling.glsl"
#include "shadow/search.glsl"

// The light's layer of a mask that the technique has drawn: G is the filter's radius.
layout(binding = UNIT_kernel_radii) uniform sampler2DArray kernels;

float read_radius(Receiver receiver, Light light) {
  return fetch_floor_radius > 0.0 ? fetch_floor_radius : search_radius(receiver, light);
}

vec2 place_at(Receiver receiver, vec2 offset, Light light) {
  return map_place(vec3(receiver.position.xy + offset, receiver.position.z), light);
}

vec4 fetch(Receiver receiver, vec2 offset, Light light) {
  return gather_stored(place_at(receiver, offset, light), light);
}

vec4 fetch_for_search(Receiver receiver, vec2 offset, Light light) {
  if (fetch_floor_blocker_reads == fetch_floor_blocker_reads_footprint) return fetch(receiver, offset, light);
  return vec4(depth_at(ivec2(floor(place_at(receiver, offset, light))), light));
}

Visibility visibility(Receiver receiver, Light light) {
  vec4 sum = vec4(0.0);
#if fetch_floor_blocker_taps > 0
  float search = narrow_search(receiver, light, light.read_radius).radius;
  // In a disc within a texel only what is at the receiver is read.
  int taps = search < 0.5 * texel_size(receiver, light) ? 1 : fetch_floor_blocker_taps;
  Scramble searching = blocker_scramble(receiver);
  int tap = 0;
  do {
    sum += fetch_for_search(receiver, search * blocker_point(tap, searching, light), light);
  } while (++tap < taps);
#endif
  float radius = fetch_floor_radius > 0.0 ? fetch_floor_radius : texelFetch(kernels, ivec3(receiver.pixel, 0), 0).y;
#if fetch_floor_filter_taps > 0
  if (radius > 0.0) {
    Scramble scramble = filter_scramble(receiver);
    int i = 0;
    do {
      sum += fetch(receiver, radius * filter_point(i, scramble, light), light);
    } while (++i < fetch_floor_filter_taps);
  }
#endif
  return Visibility(dot(sum, vec4(1e-3)), radius, 0.0, false, false);
}
