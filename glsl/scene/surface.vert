// Vertices of surfaces that are shaded.
#include "shared/view_block.h"
#include "scene/instance.glsl"

layout(std140, binding = 4) uniform ViewData { ViewBlock view; };

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 last_position;
layout(location = 2) in vec3 normal;
layout(location = 3) in vec4 tangent;
layout(location = 4) in vec4 uv;
layout(location = 5) in vec4 color;
layout(location = 6) in uint instance;

out Surface {
  vec3 world;
  vec3 normal;
  vec4 tangent;
  vec4 uv;
  vec4 color;
  vec3 clip;       // x, y, w
  vec3 last_clip;  // in the last frame
  flat uint instance;
} surface;

// Invariant, so that all passes over the same surfaces find the same one nearest.
invariant gl_Position;

void main() {
  mat4 world = instances[instance].world;
  vec4 place = world * vec4(position, 1.0);
  vec4 last_place = instances[instance].last_world * vec4(last_position, 1.0);
  gl_Position = view.world_to_clip * place;
  vec4 last_clip = view.last_world_to_clip * last_place;
  surface.world = place.xyz;
  surface.normal = mat3(instances[instance].area) * normal * instances[instance].winding;
  surface.tangent = vec4(mat3(world) * tangent.xyz, tangent.w * instances[instance].winding);
  surface.uv = uv;
  surface.color = color;
  surface.clip = gl_Position.xyw;
  surface.last_clip = last_clip.xyw;
  surface.instance = instance;
}
