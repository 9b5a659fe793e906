// The light on a scene. Radiance and illuminance are exposed: times what makes white in direct light about 1. Read by
// C++ and GLSL; std140.
#ifndef PENUMBRA_LIGHTING_BLOCK_H
#define PENUMBRA_LIGHTING_BLOCK_H

#include "shared/language.h"

GLSL_BEGIN

#define LIGHTING_MAX_LIGHTS 16

// A light that casts shadows, of which the mask has a layer.
struct DirectLightBlock {
  vec3 to_light;  // unit, world
  float pad_a;
  vec3 illuminance;  // on a plane that faces it
  float pad_b;
};

struct LightingBlock {
  vec3 sky;             // radiance, the mean over the upper hemisphere
  float ground_albedo;  // of the ground around the scene
  vec3 ground;          // radiance of that ground by direct light alone
  float ground_light;   // part of its light that reaches surfaces
  float emission;       // luminance of emission 1
  int light_count;
  int pad_a;
  int pad_b;
  DirectLightBlock lights[LIGHTING_MAX_LIGHTS];
};

GLSL_END

#endif
