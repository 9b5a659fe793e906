// Copies the receivers' depths, a little nearer to the camera, and writes the mask as if there were no casters.
#include "shadow/shadowed.glsl"
#include "shadow/drivers/gbuffer.glsl"

layout(location = 0) out vec4 mask;

uniform vec2 stored_rounding;    // of the stored depths; x: absolute, y: relative
uniform float camera_distance;  // metres from the world's origin

// Error of positions over the size of the coordinates from which they were computed.
const float relative_rounding = exp2(-22.0);

// Half the stored depths' spacing... 
float nearer_depth(Receiver receiver, vec3 position, float depth) {
  // Metres along the pixel's ray for a change of the depth.
  vec4 step = shadow.clip_to_view[2] * shadow.depth_to_ndc.x;
  vec2 ndc = (gl_FragCoord.xy - shadow.viewport.xy) / shadow.viewport.zw * 2.0 - 1.0 - shadow.jitter.xy;
  vec4 view = shadow.clip_to_view * vec4(ndc, depth * shadow.depth_to_ndc.x + shadow.depth_to_ndc.y, 1.0);
  vec3 per_depth = (step.xyz - position * step.w) / view.w;
  float error = relative_rounding * (camera_distance + length(position));
  float across = abs(dot(per_depth, view_normal_of(receiver)));
  float bias = 4.0 * (stored_rounding.x + stored_rounding.y * depth) + error / across;
  return shadow.sky_depth > 0.5 ? depth - bias : depth + bias;
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  mask = vec4(1.0, 0.0, 0.0, 0.0);
  gl_FragDepth = shadow.sky_depth;
  if (is_sky(pixel)) return;
  Receiver receiver = receiver_at(pixel);
  mask.x = faces_light(receiver) ? 1.0 : 0.0;
  gl_FragDepth = nearer_depth(receiver, view_position_at(pixel), texelFetch(receiver_depth, pixel, 0).x);
}
