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

GLSL_END

#endif
