// Copies the receivers' depths, a little nearer to the camera, and writes the mask as if nothing cast a shadow.
#include "shadow/shadowed.glsl"
#include "shadow/drivers/gbuffer.glsl"

layout(location = 0) out vec4 mask;

uniform float stored_spacing;   // between two depths that the caller's texture can hold; 0: it holds floats
uniform float camera_distance;  // from the world's origin, metres

const float rounding = exp2(-24.0);  // of a float, as a share of it
// Of depths, when they are interpolated and when they are stored, as a share of them.
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

// A receiver is on the near cap of its own triangle's volume. On the side of a surface that the sun lights and the
// camera sees, nearer to the camera is out of the volume. So its depth is changed by as much as rounding may have
// moved the receiver and the cap apart: across the surface, which is more along the ray where the view grazes it, and
// in the stored depth.
float depth_before_cap(Receiver receiver, vec3 position, ivec2 pixel, float depth) {
  float apart = position_rounding_share * (camera_distance + length(position));
  float across = abs(dot(position_per_depth(pixel, position, depth), view_normal_of(receiver)));
  float change = stored_spacing + depth_rounding_share * depth + apart / across;
  return shadow.sky_depth > 0.0 ? depth - change : depth + change;
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  mask = vec4(1.0, 0.0, 0.0, 0.0);
  gl_FragDepth = shadow.sky_depth;
  if (is_sky(pixel)) return;
  Receiver receiver = receiver_at(pixel);
  mask.x = faces_light(receiver) ? 1.0 : 0.0;
  float depth = texelFetch(receiver_depth, pixel, 0).x;
  gl_FragDepth = depth_before_cap(receiver, view_position_at(pixel), pixel, depth);
}
