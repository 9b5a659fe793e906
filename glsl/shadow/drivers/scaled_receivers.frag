// The receivers of every n-th pixel of each row and column.
layout(binding = 2) uniform sampler2D receiver_depth;
layout(binding = 3) uniform sampler2D receiver_normal;
layout(binding = 8) uniform sampler2D receiver_motion;

uniform ivec2 corner;  // of the viewport
uniform int scale;
uniform vec2 ndc_scale;  // from the NDC of the caller's view to those of the view that has only these pixels

layout(location = 0) out float depth;
layout(location = 1) out vec4 normal;
layout(location = 2) out vec2 motion;

void main() {
  ivec2 pixel = corner + scale * ivec2(gl_FragCoord.xy);
  depth = texelFetch(receiver_depth, pixel, 0).x;
  normal = texelFetch(receiver_normal, pixel, 0);
  motion = texelFetch(receiver_motion, pixel, 0).xy * ndc_scale;
}
