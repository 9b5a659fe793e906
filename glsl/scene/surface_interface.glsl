// What the vertices of a surface pass on to its fragments: only what its program, which is compiled for what the
// surface has, reads. The including file defines SURFACE as `in` or `out`. Its constants:
//   TEXTURES   bit i: its materials may have texture i (shared/scene_blocks.h)
//   TRANSFORMS bit i: one of them may read texture i otherwise than at the first texture coordinates as they are
//   COLORS     the vertices have colours
//   MASKED     whether an alpha test cuts parts out of it
//   TRIANGLES  0: lines or points
//   NORMALS    whether the normals are read; if not, the index of the instance is
//   WORLD      whether the position is read
//   MOTION     whether the motion vector is read
SURFACE Surface {
#if NORMALS
  vec3 normal;
#if TRIANGLES
  flat uint first_triangle;  // of the primitive, in the triangle normals
  flat vec3 area_x, area_y, area_z;  // columns of the matrix from triangle normals to world space
#if !MASKED
  float lean;  // see smooth_lean()
#endif
#endif
#else
  flat uint instance;
#endif
#if WORLD || !TRIANGLES
  vec3 world;
#endif
#if TEXTURES & (1 << TEXTURE_NORMAL)
  vec4 tangent;
#endif
#if TEXTURES
  vec4 uv;
#endif
#if COLORS
  vec4 color;
#endif
#if MOTION
  vec3 clip;       // x, y, w
  vec3 last_clip;  // in the last frame
#endif
} surface;
