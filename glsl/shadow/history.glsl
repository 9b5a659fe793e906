// Finds a receiver's position in the last frame, and whether the same surface was visible there (Nehab et al. 2007,
// "Accelerating real-time shading with reverse reprojection caching"). Bilinear taps that show another surface get
// weight 0.
#include "shadow/drivers/gbuffer.glsl"
#include "lib/packed_texel.glsl"

layout(binding = 8) uniform sampler2D receiver_motion;
// The surface at each pixel in the last frame. x: bits of the caller's depth; y: normal in light space, octahedral,
// SNORM16.
layout(binding = 9) uniform usampler2D last_surface;

struct Reprojection {
  uint refusal;  // HISTORY_KEPT, else why the history was rejected (packed_texel.glsl)
  ivec2 corner;  // lower left of the four pixels of the bilinear footprint
  vec2 part;     // from the corner's centre to the last position, pixels
  vec4 weights;  // of (0,0) (1,0) (0,1) (1,1); their sum is 1
};

Reprojection refused(uint why) { return Reprojection(why, ivec2(0), vec2(0.0), vec4(0.0)); }

// NDC, with jitter removed, of a position in the viewport given in pixels.
vec2 ndc_at(vec2 place, vec2 jitter) { return place / shadow.viewport.zw * 2.0 - 1.0 - jitter; }

uvec2 surface_bits(ivec2 pixel, Receiver receiver) {
  return uvec2(floatBitsToUint(texelFetch(receiver_depth, pixel, 0).x),
               packSnorm2x16(octahedral_encode(shared_normal_of(receiver))));
}

// The tolerances within which a surface of the last frame counts as the receiver's.
struct Likeness {
  vec3 position;      // view space
  vec3 normal;        // the same
  float distance_to;  // from the receiver's plane, metres, at most
  float cosine;       // of the angle between the normals, at least
};

bool is_own(Likeness like, Receiver receiver, ivec2 tap) {
  if (any(lessThan(tap, ivec2(0))) || any(greaterThanEqual(tap, ivec2(shadow.viewport.zw)))) return false;
  uvec2 stored = texelFetch(last_surface, tap + ivec2(shadow.viewport.xy), 0).xy;
  float depth = uintBitsToFloat(stored.x);
  if (depth == shadow.sky_depth) return false;
  vec4 clip = vec4(ndc_at(vec2(tap) + 0.5, shadow.jitter.zw), depth * shadow.depth_to_ndc.x + shadow.depth_to_ndc.y,
                   1.0);
  vec4 place = shadow.last_clip_to_view * clip;
  float off = dot(like.normal, place.xyz / place.w - like.position);
  return abs(off) <= like.distance_to &&
         dot(octahedral_decode(unpackSnorm2x16(stored.y)), shared_normal_of(receiver)) >= like.cosine;
}

// A receiver's last position by its motion vector, and its last position if only the camera had moved.
struct LastPlace {
  vec2 ndc, at_rest;  // without jitter
  bool before_camera;
};

LastPlace last_place(ivec2 pixel, vec3 position) {
  vec4 clip = shadow.view_to_last_clip * vec4(position, 1.0);
  LastPlace last;
  last.at_rest = clip.xy / clip.w;
  last.before_camera = clip.w > 0.0;
  vec2 ndc = ndc_at(vec2(pixel) + 0.5 - shadow.viewport.xy, shadow.jitter.xy);
  last.ndc = shadow.has_motion != 0 ? ndc - texelFetch(receiver_motion, pixel, 0).xy : last.at_rest;
  return last;
}

// If the receiver itself moved, its distance from its plane in the last frame may be as large as its motion across the
// picture.
Likeness likeness_of(Receiver receiver, vec3 position, LastPlace last) {
  float width = pixel_width(position);
  float way = length((last.ndc - last.at_rest) * 0.5 * shadow.viewport.zw) * width;
  return Likeness(position, view_normal_of(receiver), history_distance * width + way,
                  cos(radians(history_turn)));
}

Reprojection reproject(Receiver receiver, ivec2 pixel) {
  if (shadow.history_valid == 0) return refused(HISTORY_NONE);
  vec3 position = view_position_of(receiver);
  LastPlace last = last_place(pixel, position);
  vec2 place = ((last.ndc + shadow.jitter.zw) * 0.5 + 0.5) * shadow.viewport.zw;
  bool inside = all(greaterThanEqual(place, vec2(0.0))) && all(lessThan(place, shadow.viewport.zw));
  if (!inside || !last.before_camera) return refused(HISTORY_OFF_SCREEN);

  // Offsets caused by rounding alone snap to the pixel: else a still picture would blur.
  vec2 at = place - 0.5;
  at = mix(at, round(at), lessThan(abs(at - round(at)), vec2(1.0 / 256.0)));
  ivec2 corner = ivec2(floor(at));
  vec2 part = at - vec2(corner);
  vec4 weights = vec4((1.0 - part.x) * (1.0 - part.y), part.x * (1.0 - part.y), (1.0 - part.x) * part.y,
                      part.x * part.y);
  Likeness like = likeness_of(receiver, position, last);
  for (int i = 0; i < 4; ++i) {
    if (weights[i] > 0.0 && !is_own(like, receiver, corner + ivec2(i & 1, i >> 1))) weights[i] = 0.0;
  }
  float sum = weights.x + weights.y + weights.z + weights.w;
  if (sum < 0.01) return refused(HISTORY_OTHER_SURFACE);
  return Reprojection(HISTORY_KEPT, corner, part, weights / sum);
}
