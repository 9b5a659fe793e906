#ifndef PENUMBRA_TRIANGLE_NORMAL_GLSL
#define PENUMBRA_TRIANGLE_NORMAL_GLSL

#include "shared/language.h"

GLSL_BEGIN

// A vector along the normal of a triangle, on the side from which its corners are counter-clockwise; 0 for triangles
// without area. The edges are scaled first, so that no product of tiny or huge ones leaves the range of floats.
GLSL_FUNCTION vec3 triangle_normal(vec3 a, vec3 b, vec3 c) {
  vec3 edge = b - a;
  vec3 other = c - a;
  vec3 largest = max(abs(edge), abs(other));
  float size = max(max(largest.x, largest.y), largest.z);
  if (!(size > 0.0f)) return vec3(0.0f);
  return cross(edge / size, other / size);
}

// How far a triangle's smooth normals, of unit length, lean away from its own, which may have any length: the sine of
// the largest angle; 0 for triangles without area.
GLSL_FUNCTION float smooth_lean(vec3 normal, vec3 at_a, vec3 at_b, vec3 at_c) {
  vec3 parts = abs(normal);
  float size = max(max(parts.x, parts.y), parts.z);
  if (!(size > 0.0f)) return 0.0f;
  vec3 unit = normal / size;
  unit = unit / sqrt(dot(unit, unit));
  vec3 a = cross(unit, at_a), b = cross(unit, at_b), c = cross(unit, at_c);
  return sqrt(max(max(dot(a, a), dot(b, b)), dot(c, c)));
}

GLSL_END

#endif
