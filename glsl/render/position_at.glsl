// Where a pixel's surface is. The file that includes this has the G-buffer's depth and the view.

uniform mat4 clip_to_world;

vec3 position_at(ivec2 pixel) {
  vec2 ndc = gl_FragCoord.xy * view.viewport.zw * 2.0 - 1.0;
  float depth = texelFetch(gbuffer_depth, pixel, 0).x;
  vec4 world = clip_to_world * vec4(ndc, depth, 1.0);
  return world.xyz / world.w;
}
