#ifndef PENUMBRA_PROJECTION_GLSL
#define PENUMBRA_PROJECTION_GLSL

#include "shared/language.h"

GLSL_BEGIN

// Number of pixels along an axis of the picture that one metre on a plane covers. `across`: step from one pixel's point
// to the next pixel's, metres, parallel to the image plane. The next pixel sees the point where its ray meets the
// plane, which is `across` moved along the ray back to the plane:
//   on_plane = across − ray · (n·across / n·ray),   pixels = 1 / |on_plane|.
// For a plane that faces the camera that is height / (2 · tan(fov/2) · z); it goes to 0 where the view grazes the
// plane. Lengths of ray and normal do not matter.
GLSL_FUNCTION float pixels_a_metre(vec3 across, vec3 ray, vec3 normal) {
  float facing = dot(normal, ray);
  vec3 on_plane = across * facing - ray * dot(normal, across);
  return abs(facing) / max(length(on_plane), 1e-30f);
}

GLSL_END

#endif
