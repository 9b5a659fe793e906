// Reads receivers from the caller's depth and normals, for a technique's own passes.
#include "shadow/light.glsl"
#include "lib/octahedral.glsl"

layout(binding = 2) uniform sampler2D receiver_depth;
layout(binding = 3) uniform sampler2D receiver_normal;

// Whether the pixel shows only sky.
bool is_sky(ivec2 pixel) { return texelFetch(receiver_depth, pixel, 0).x == shadow.sky_depth; }

float ndc_depth(float depth) { return depth * shadow.depth_to_ndc.x + shadow.depth_to_ndc.y; }

// View-space position of a point of the picture, pixels, with that stored depth: homogeneous, and in metres.
vec4 unproject_with_w(vec2 at, float depth) {
  vec2 ndc = (at - shadow.viewport.xy) / shadow.viewport.zw * 2.0 - 1.0 - shadow.jitter.xy;
  return shadow.clip_to_view * vec4(ndc, ndc_depth(depth), 1.0);
}
vec3 unproject(vec2 at, float depth) {
  vec4 view = unproject_with_w(at, depth);
  return view.xyz / view.w;
}

// The most by which a view-space position, made from that stored depth, may be off along its view ray, metres.
vec3 position_error(vec3 position, float depth) {
  float error = shadow.depth_error.x + shadow.depth_error.y * abs(ndc_depth(depth));
  float clip_w = shadow.pixel_size.z * position.z + shadow.pixel_size.w;
  return error * clip_w * (shadow.clip_to_view[2].xyz - position * shadow.clip_to_view[2].w);
}

// A packed texel with the bits of its pixel's stored depth, as passes of denoisers hand them on: filters need both of
// each neighbour, and so read them at once.
uvec2 texel_with_depth(uint texel, ivec2 pixel) {
  return uvec2(texel, floatBitsToUint(texelFetch(receiver_depth, pixel, 0).x));
}

// View-space position (metres) of a pixel that is not sky.
vec3 view_position_at(ivec2 pixel) { return unproject(vec2(pixel) + 0.5, texelFetch(receiver_depth, pixel, 0).x); }

// What the normals texture holds for a pixel that is not sky.
struct StoredNormal {
  vec3 normal;  // geometric, light space
  vec2 apart;   // where it was made from depths: distances of the points that it was made from, metres
};

StoredNormal stored_normal_at(ivec2 pixel) {
  vec4 texel = texelFetch(receiver_normal, pixel, 0);
  vec3 stored = texel.xyz * shadow.normal_decode.x + shadow.normal_decode.y;
  vec3 along = shadow.octahedral_normals != 0 ? octahedral_direction(stored.xy) : stored;
  return StoredNormal(light_direction(normalize(along)), texel.zw);
}

vec3 light_normal_at(ivec2 pixel) { return stored_normal_at(pixel).normal; }

Receiver receiver_at(ivec2 pixel) {
  float depth = texelFetch(receiver_depth, pixel, 0).x;
  vec3 position = unproject(vec2(pixel) + 0.5, depth);
  StoredNormal stored = stored_normal_at(pixel);
  Receiver receiver = make_receiver(position, stored.normal, vec2(pixel));
  vec3 moves = plane_moves(receiver);
  receiver.depth_error = abs(dot(moves, position_error(position, depth))) + vertex_error(moves, position);
  if (shadow.normals_from_depth != 0) {
    // Both ends may be off, and a metre across the light is more on a plane that is steep along it.
    float longer = sqrt(1.0 + dot(receiver.gradient, receiver.gradient));
    receiver.depth_tilt = 2.0 * receiver.depth_error * longer * (1.0 / stored.apart.x + 1.0 / stored.apart.y);
  }
  return receiver;
}
