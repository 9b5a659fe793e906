// The surface in a fragment shader: colour, normals, motion. Compiled for what the surface has: see
// surface_interface.glsl.
#include "shared/view_block.h"
#include "scene/material.glsl"

#define SURFACE in
#include "scene/surface_interface.glsl"

layout(std140, binding = 4) uniform ViewData { ViewBlock view; };
layout(std430, binding = 2) readonly restrict buffer TriangleNormals { float triangle_normals[]; };

vec4 surface_uv() {
#if TEXTURES
  return surface.uv;
#else
  return vec4(0.0);
#endif
}

vec4 surface_color() {
#if COLORS
  return base_color(surface_uv(), surface.color);
#else
  return base_color(surface_uv(), vec4(1.0));
#endif
}

// Discards where the alpha test cuts the surface out. The pass before has left no depth of it there, but another
// surface may lie at the same depth. The tolerance is for rounding, which may differ from that pass's: it has decided
// already. To be called after all texture reads: mip levels need the derivatives of the whole quad.
void cut_out(float alpha) {
#if MASKED
  if (alpha < material.alpha_cutoff - 1e-4) discard;
#endif
}

#if WORLD || !TRIANGLES
// Vector from the camera to the surface.
vec3 view_ray() { return view.camera.w != 0.0 ? view.forward.xyz : surface.world - view.camera.xyz; }
#endif

#if NORMALS
// How far smooth normals lean away from the triangles' own, as src/scene/smooth_lean.h says; 0 where the surface is not
// part of a round body, as leaves are not that an alpha test cuts out of sheets.
float smooth_lean() {
#if TRIANGLES && !MASKED
  return surface.lean;
#else
  return 0.0;
#endif
}

// The triangle's geometric normal in world space, on the camera's side, not of unit length. It comes from the
// triangle's vertices, because derivatives of the position are too inexact for wide kernels, which multiply the error.
// Triangles without area, lines and points take their shading normal, or where there is none a direction to the camera.
vec3 geometric_normal() {
#if TRIANGLES
  uint at = 3u * (surface.first_triangle + uint(gl_PrimitiveID));
  vec3 n = mat3(surface.area_x, surface.area_y, surface.area_z) *
           vec3(triangle_normals[at], triangle_normals[at + 1u], triangle_normals[at + 2u]);
  float size = max(abs(n.x), max(abs(n.y), abs(n.z)));
  if (!(size > 0.0)) {
    // On the screen rounding may give a triangle without area some pixels. Software rasterisers interpolate nothing
    // finite over a part of them.
    if (!(dot(surface.normal, surface.normal) > 0.0)) return -view.forward.xyz;
    return gl_FrontFacing ? surface.normal : -surface.normal;
  }
  return n * ((gl_FrontFacing ? 1.0 : -1.0) / size);
#else
  if (!(dot(surface.normal, surface.normal) > 0.0)) return -view_ray();
  return dot(surface.normal, view_ray()) > 0.0 ? -surface.normal : surface.normal;
#endif
}

// The shading normal, with the normal map applied, of unit length. It is flipped on back faces, which only double-sided
// materials show.
vec3 shading_normal(vec3 geometric) {
#if TEXTURES & (1 << TEXTURE_NORMAL)
  // Before any return: mip levels need the derivatives of the whole quad.
  vec3 mapped = texture(normal_texture, texture_uv(TEXTURE_NORMAL, surface.uv)).xyz * 2.0 - 1.0;
#endif
  float square = dot(surface.normal, surface.normal);
  if (!(square > 0.0)) return normalize(geometric);
  vec3 n = surface.normal * inversesqrt(square);
#if TEXTURES & (1 << TEXTURE_NORMAL)
  mapped.xy *= material.normal_scale;
  vec3 t = surface.tangent.xyz;
  t *= inversesqrt(max(dot(t, t), 1e-30));  // stays zero without tangents
  vec3 bent = mapped.x * t + mapped.y * surface.tangent.w * cross(n, t) + mapped.z * n;
  float bent_square = dot(bent, bent);
  if (bent_square > 1e-12) n = bent * inversesqrt(bent_square);
#endif
  return gl_FrontFacing ? n : -n;
}
#endif

#if MOTION
// The motion vector: present minus last position, in NDC.
vec2 motion() {
  if (!(surface.last_clip.z > 0.0)) return vec2(0.0);
  return surface.clip.xy / surface.clip.z - surface.last_clip.xy / surface.last_clip.z;
}
#endif
