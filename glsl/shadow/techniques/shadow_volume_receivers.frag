// Writes the mask as if nothing cast a shadow, and where volumes are looked for: the receivers' places and depths.
#include "shadow/shadowed.glsl"
#include "shadow/drivers/gbuffer.glsl"

layout(location = 0) out vec4 mask;
layout(location = 1) out vec4 place;  // metres along the world's axes from the camera

uniform mat4 view_to_world;
// The most by which the format of the caller's texture changes a depth, over what 32-bit floats change. x: absolute; y:
// as a share of the depth.
uniform vec2 stored_rounding;
uniform float camera_distance;  // from the world's origin, metres

const float rounding = exp2(-24.0);  // of a float, as a share of it
// Of depths, when they are interpolated, stored and turned into NDC, as a share of them.
const float depth_rounding_share = 3.0 * rounding;
// Of positions, over the size of the coordinates that they are computed from.
const float position_rounding_share = 8.0 * rounding;

// Change of the view-space position along the pixel's ray for a change of the stored depth, metres.
vec3 position_per_depth(ivec2 pixel, vec3 position, float depth) {
  vec2 ndc = (vec2(pixel) + 0.5 - shadow.viewport.xy) / shadow.viewport.zw * 2.0 - 1.0 - shadow.jitter.xy;
  vec4 at = shadow.clip_to_view * vec4(ndc, depth * shadow.depth_to_ndc.x + shadow.depth_to_ndc.y, 1.0);
  vec4 change = shadow.clip_to_view[2] * shadow.depth_to_ndc.x;
  return (change.xyz - position * change.w) / at.w;
}

// A receiver is on its own triangle, behind which it must not be. On the side of a surface that the light shines on and
// the camera sees, nearer to the camera is nearer to the light than the surface. So its depth is changed by as much as
// rounding may have moved the receiver and the triangle apart: across the surface, which is more along the ray where
// the view grazes it, in the stored depth, and by the rasteriser's grid.
float change_to_clear_surface(Receiver receiver, vec3 position, vec3 per_depth, float depth) {
  vec3 normal = view_normal_of(receiver);
  float apart = position_rounding_share * (camera_distance + length(position));
  apart += dot(rounding_of_vertices(position), abs(normal.xy));
  float across = abs(dot(per_depth, normal));
  float size = depth + abs(shadow.depth_to_ndc.y / shadow.depth_to_ndc.x);
  return stored_rounding.x + stored_rounding.y * depth + depth_rounding_share * size + apart / across;
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  mask = vec4(1.0, 0.0, 0.0, 0.0);
  place = vec4(0.0);
  gl_FragDepth = shadow.sky_depth;
  if (is_sky(pixel)) return;
  Receiver receiver = receiver_at(pixel);
  if (!faces_light(receiver)) {
    mask.x = 0.0;
    return;
  }
  float depth = texelFetch(receiver_depth, pixel, 0).x;
  float nearer = shadow.sky_depth > 0.0 ? -1.0 : 1.0;
  vec3 position = view_position_at(pixel);
  vec3 per_depth = position_per_depth(pixel, position, depth);
  float change = change_to_clear_surface(receiver, position, per_depth, depth);
  float clear = clamp(depth + nearer * change, 0.0, 1.0);
  place.xyz = mat3(view_to_world) * unproject(vec2(pixel) + 0.5, clear);
  // The faces that end the volumes of this receiver are behind it. To find them for certain, it is tested a pixel's
  // width nearer.
  gl_FragDepth = depth + nearer * (2.0 * change + pixel_width(position) / length(per_depth));
}
