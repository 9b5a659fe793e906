// The lighting of a scene. Radiance and illuminance are multiplied by the exposure, which makes a white surface in
// direct light about 1. Read by C++ and GLSL; std140.
#ifndef PENUMBRA_LIGHTING_BLOCK_H
#define PENUMBRA_LIGHTING_BLOCK_H

#include "shared/language.h"

GLSL_BEGIN

#define LIGHTING_MAX_LIGHTS 64

// A light. The first ones cast shadows, each with its layer of the mask.
struct DirectLightBlock {
  vec3 place;           // of a sun: unit vector towards it, world; of a lamp: its centre, world, metres
  float least_square;   // of a lamp: the least square of a distance, metres²; 0: a sun
  vec3 illuminance;     // of a sun: on a plane perpendicular to it; of a lamp: at a distance of 1 m
  float inverse_range;  // of a lamp, 1/m; 0: unlimited
  vec3 axis;            // of a spot: unit, world
  float cone_scale;     // a spot's light is the square of cosine · scale + offset, clamped to 0..1
  float cone_offset;
  float pad_a, pad_b, pad_c;
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
