// The lighting of a scene. Radiance and illuminance are multiplied by the exposure, which makes a white surface in
// direct light about 1. Read by C++ and GLSL; std140.
#ifndef PENUMBRA_LIGHTING_BLOCK_H
#define PENUMBRA_LIGHTING_BLOCK_H

#include "shared/language.h"

GLSL_BEGIN

#define LIGHTING_MAX_LIGHTS 16

// A light that casts shadows; it has one layer of the mask.
struct DirectLightBlock {
  vec3 to_light;  // unit, world
  float pad_a;
  vec3 illuminance;  // on a plane perpendicular to it
  float pad_b;
};

struct LightingBlock {
  vec3 sky;             // radiance, the mean over the upper hemisphere
  float ground_albedo;  // of the ground around the scene
  vec3 ground;          // radiance of that ground by direct light alone
  float ground_light;   // fraction of its light that reaches surfaces
  float emission;       // luminance of a material's emission of 1
  int light_count;
  int pad_a;
  int pad_b;
  DirectLightBlock lights[LIGHTING_MAX_LIGHTS];
};

GLSL_END

#endif
