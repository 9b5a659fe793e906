// Shadow casters: position, and texture coordinates for alpha-tested materials.
#if LAST_POSE
#include "scene/instance.glsl"
#endif

#if LAST_POSE
layout(location = 1) in vec3 position;
#else
layout(location = 0) in vec3 position;
#endif
layout(location = 4) in vec4 uv;
layout(location = 5) in vec4 color;
#if LAST_POSE
layout(location = 6) in uint instance;
#else
layout(location = 7) in mat4 world;
#endif

#if ANCHORED
uniform mat4 anchored_to_clip;  // of positions less the anchor
uniform vec3 anchor;            // world space
#else
uniform mat4 world_to_clip;
#endif

// Invariant, because later passes test against the depths that this one leaves and must compute bit-identical
// positions. Without ANCHORED surface.vert computes them by the same expressions: the G-buffer tests for equal depth.
invariant gl_Position;

#if MASKED
out Caster {
  vec4 uv;
  vec4 color;
} caster;
#endif

void main() {
#if LAST_POSE
  mat4 world = instances[instance].last_world;
#endif
#if ANCHORED
  vec4 place = world * vec4(position, 1.0);
  place.xyz -= anchor;
  gl_Position = anchored_to_clip * place;
#else
  gl_Position = world_to_clip * (world * vec4(position, 1.0));
#endif
#if MASKED
  caster.uv = uv;
  caster.color = color;
#endif
}
