// The surface in a fragment shader: colour, normals, motion.
#include "shared/view_block.h"
#include "scene/instance.glsl"
#include "scene/material.glsl"

layout(std140, binding = 4) uniform ViewData { ViewBlock view; };
layout(std430, binding = 2) readonly restrict buffer Indices { uint indices[]; };
layout(std430, binding = 3) readonly restrict buffer Positions { float positions[]; };

in Surface {
  vec3 world;
  vec3 normal;
  vec4 tangent;
  vec4 uv;
  vec4 color;
  vec3 clip;
  vec3 last_clip;
  flat uint instance;
} surface;

vec3 corner(uint index) {
  uint at = 3u * (instances[surface.instance].base_vertex + indices[index]);
  return vec3(positions[at], positions[at + 1u], positions[at + 2u]);
}

// Vector from the camera to the surface.
vec3 view_ray() { return view.camera.w != 0.0 ? view.forward.xyz : surface.world - view.camera.xyz; }

vec3 towards_eye(vec3 n) { return dot(n, view_ray()) > 0.0 ? -n : n; }

// The triangle's geometric normal in world space, on the camera's side, not of unit length. Computed from the
// triangle's vertices, because derivatives of the position are too inexact for wide kernels, which multiply the error.
// Lines and points take their shading normal.
vec3 geometric_normal() {
  InstanceBlock instance = instances[surface.instance];
  if ((instance.flags & INSTANCE_TRIANGLES) == 0u) return towards_eye(surface.normal);
  uint first = instance.first_index + 3u * uint(gl_PrimitiveID);
  vec3 a = corner(first);
  vec3 edge = corner(first + 1u) - a;
  vec3 other = corner(first + 2u) - a;
  vec3 largest = max(abs(edge), abs(other));
  float scale = max(max(largest.x, largest.y), largest.z);
  vec3 n = mat3(instance.area) * cross(edge / scale, other / scale);
  float size = max(abs(n.x), max(abs(n.y), abs(n.z)));
  if (!(size > 0.0)) return towards_eye(surface.normal);
  return n * ((gl_FrontFacing ? instance.winding : -instance.winding) / size);
}

// The shading normal, with the normal map applied, of unit length. It is flipped on back faces, which only double-sided
// materials show.
vec3 shading_normal(vec3 geometric) {
  float square = dot(surface.normal, surface.normal);
  if (!(square > 0.0)) return normalize(geometric);
  vec3 n = surface.normal * inversesqrt(square);
  if (has_texture(TEXTURE_NORMAL)) {
    vec3 mapped = texture(normal_texture, texture_uv(TEXTURE_NORMAL, surface.uv)).xyz * 2.0 - 1.0;
    mapped.xy *= material.normal_scale;
    vec3 t = surface.tangent.xyz;
    t *= inversesqrt(max(dot(t, t), 1e-30));  // stays zero without tangents
    vec3 bent = mapped.x * t + mapped.y * surface.tangent.w * cross(n, t) + mapped.z * n;
    float bent_square = dot(bent, bent);
    if (bent_square > 1e-12) n = bent * inversesqrt(bent_square);
  }
  return gl_FrontFacing ? n : -n;
}

// The motion vector: present minus last position, in NDC.
vec2 motion() {
  if (!(surface.last_clip.z > 0.0)) return vec2(0.0);
  return surface.clip.xy / surface.clip.z - surface.last_clip.xy / surface.last_clip.z;
}
