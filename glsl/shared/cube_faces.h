// The faces of a cube about a lamp: +z −z +x −x +y −y, in the lamp's space. Read by C++ and GLSL.
#ifndef PENUMBRA_CUBE_FACES_H
#define PENUMBRA_CUBE_FACES_H

#include "shared/language.h"

GLSL_BEGIN

// A vector as a face sees it: z along the face's axis, x and y across it. Rotations: no mirror images.
GLSL_FUNCTION vec3 seen_by_face(vec3 p, int face) {
  if (face == 0) return p;
  if (face == 1) return vec3(-p.x, p.y, -p.z);
  if (face == 2) return vec3(-p.z, p.y, p.x);
  if (face == 3) return vec3(p.z, p.y, -p.x);
  if (face == 4) return vec3(p.x, -p.z, p.y);
  return vec3(p.x, p.z, -p.y);
}

// And back.
GLSL_FUNCTION vec3 from_face(vec3 p, int face) {
  if (face == 0) return p;
  if (face == 1) return vec3(-p.x, p.y, -p.z);
  if (face == 2) return vec3(p.z, p.y, -p.x);
  if (face == 3) return vec3(-p.z, p.y, p.x);
  if (face == 4) return vec3(p.x, p.z, -p.y);
  return vec3(p.x, -p.z, p.y);
}

// The faces in order of how straight they look at a vector: x the one that contains it, y the next one.
GLSL_FUNCTION ivec2 faces_of(vec3 p) {
  vec3 far = vec3(abs(p.x), abs(p.y), abs(p.z));
  int x = p.x < 0.0f ? 3 : 2, y = p.y < 0.0f ? 5 : 4, z = p.z < 0.0f ? 1 : 0;
  if (far.z >= far.x && far.z >= far.y) return ivec2(z, far.x >= far.y ? x : y);
  if (far.x >= far.y) return ivec2(x, far.z >= far.y ? z : y);
  return ivec2(y, far.z >= far.x ? z : x);
}

GLSL_END

#endif
