// The faces of a cube about a lamp: +z −z +x −x +y −y, in the lamp's space, and how wide their maps are. Read by C++
// and GLSL.
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

// The three faces before which a vector lies, in order of how straight they look at it: x is the one that contains it.
GLSL_FUNCTION ivec3 faces_of(vec3 p) {
  vec3 far = vec3(abs(p.x), abs(p.y), abs(p.z));
  int x = p.x < 0.0f ? 3 : 2, y = p.y < 0.0f ? 5 : 4, z = p.z < 0.0f ? 1 : 0;
  if (far.z >= far.x && far.z >= far.y) return far.x >= far.y ? ivec3(z, x, y) : ivec3(z, y, x);
  if (far.x >= far.y) return far.z >= far.y ? ivec3(x, z, y) : ivec3(x, y, z);
  return far.z >= far.x ? ivec3(y, z, x) : ivec3(y, x, z);
}

// The distance from the centre of a lamp of this radius, metres, from which on its maps are wide enough: receivers at
// the edge of a face, or of a spot's cone, see all of a caster that is at least so far from the lamp.
GLSL_FUNCTION float clear_distance(float radius) { return max(2.0f * radius, 0.2f); }

GLSL_END

#endif
