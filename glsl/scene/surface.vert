// Vertices of surfaces that are shaded.
#include "shared/view_block.h"
#include "scene/instance.glsl"

#define SURFACE out
#include "scene/surface_interface.glsl"

layout(std140, binding = 4) uniform ViewData { ViewBlock view; };

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 last_position;
layout(location = 2) in vec4 normal;  // w: the lean of smooth normals
layout(location = 3) in vec4 tangent;
layout(location = 4) in vec4 uv;
layout(location = 5) in vec4 color;
layout(location = 6) in uint instance;
// Of the instance, from the buffer of its blocks: attributes that advance with the instance cost less to read and to
// compile than the buffer itself.
layout(location = 7) in mat4 world;
layout(location = 11) in mat3 area;
layout(location = 14) in uint first_triangle;
layout(location = 15) in float winding;

// Invariant, and by the same expressions as in caster.vert, which draws the depth that these passes test for equality.
invariant gl_Position;

void main() {
  vec4 place = world * vec4(position, 1.0);
  gl_Position = view.world_to_clip * place;
#if NORMALS
  surface.normal = area * normal.xyz * winding;
#if TRIANGLES
  surface.first_triangle = first_triangle;
  surface.area_x = area[0] * winding;
  surface.area_y = area[1] * winding;
  surface.area_z = area[2] * winding;
#if !MASKED
  surface.lean = normal.w;
#endif
#endif
#if TEXTURES & (1 << TEXTURE_NORMAL)
  surface.tangent = vec4(mat3(world) * tangent.xyz, tangent.w * winding);
#endif
#else
  surface.instance = instance;
#endif
#if WORLD || !TRIANGLES
  surface.world = place.xyz;
#endif
#if TEXTURES
  surface.uv = uv;
#endif
#if COLORS
  surface.color = color;
#endif
#if MOTION
  surface.clip = gl_Position.xyw;
  surface.last_clip = (view.last_world_to_clip * (instances[instance].last_world * vec4(last_position, 1.0))).xyw;
#endif
}
