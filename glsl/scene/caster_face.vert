// Shadow casters of which one face casts shadows, for geometry shaders, which run before faces are culled. Drawn
// without an index buffer: the shader reads the three corners of its triangle, and where the other face is towards the
// light it puts all of them in one place.
#include "scene/instance.glsl"

layout(location = 6) in uint instance;

// Names that begin with "caster", because a technique's geometry shader must not have others of the same name.
layout(std430, binding = 2) readonly restrict buffer CasterIndices { uint caster_indices[]; };
layout(std430, binding = 3) readonly restrict buffer CasterPositions { float caster_positions[]; };

uniform mat4 world_to_clip;
uniform vec4 caster_light;  // world space; w = 0: the direction to it, w = 1: its position
uniform float caster_side;  // 1: the front faces cast, -1: the back faces

// The same expressions as in caster.vert, so that a surface has the same positions in all passes.
invariant gl_Position;

vec3 corner(uint index) {
  uint at = 3u * (instances[instance].base_vertex + caster_indices[index]);
  return vec3(caster_positions[at], caster_positions[at + 1u], caster_positions[at + 2u]);
}

void main() {
  uint number = uint(gl_VertexID) - instances[instance].first_index;
  uint first = uint(gl_VertexID) - number % 3u;
  vec3 a = corner(first);
  vec3 b = corner(first + 1u);
  vec3 c = corner(first + 2u);
  mat4 world = instances[instance].world;
  vec3 front = instances[instance].winding * (mat3(instances[instance].area) * cross(b - a, c - a));
  vec3 to_light = caster_light.xyz - caster_light.w * (world * vec4(a, 1.0)).xyz;
  bool casts = caster_side * dot(front, to_light) > 0.0;
  vec3 position = casts ? corner(uint(gl_VertexID)) : a;
  gl_Position = world_to_clip * (world * vec4(position, 1.0));
}
