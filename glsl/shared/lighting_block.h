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

// The light from all around, of sky, ground and lamps. Of a unit vector, y is its height and u its part towards the
// side of the horizon where the sun is.
struct AmbientLight {
  vec3 ground;  // radiance of the ground around the scene, in the open
  float pad_a;
  // What surfaces mirror from above the horizon: radiance at the zenith, and what the horizon has besides; its side
  // where the sun is has u times this share of the zenith's more.
  vec3 zenith;
  float side;
  vec3 horizon;
  float pad_b;
  // Irradiance over pi on a plane by its normal: `vertical` times 1 and the shares of y², u, yu and u², and `upward`
  // times y.
  vec3 vertical;
  float pad_c;
  vec3 upward;
  float pad_d;
  vec4 shares;
  vec2 sun_side;  // x and z of a unit vector
  vec2 pad_e;
};

struct LightingBlock {
  AmbientLight ambient;
  vec3 ground_albedo;   // of the ground around the scene
  float ground_height;  // world, metres
  float scene_reach;    // from the eye to the farthest place of the scene on the ground, metres
  float sky;            // radiance for each 1 in the table of the sky
  float room;           // radiance of the surroundings by the light of lamps
  float emission;       // luminance of a material's emission of 1
  int light_count;
  float soft_terminator;  // 1: light fades out on smooth bodies before their triangles turn away; else 0
  int pad_a, pad_b;
  DirectLightBlock lights[LIGHTING_MAX_LIGHTS];
};

GLSL_END

#endif
