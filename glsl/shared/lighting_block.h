// The light on a scene. Radiance and illuminance are exposed: times what makes white in the sun about 1. Read by C++
// and GLSL; std140.
#ifndef PENUMBRA_LIGHTING_BLOCK_H
#define PENUMBRA_LIGHTING_BLOCK_H

#include "shared/language.h"

GLSL_BEGIN

struct LightingBlock {
  vec4 to_sun;  // xyz: unit, world; w: luminance of emission 1
  vec4 sun;     // rgb: illuminance on a plane that faces it
  vec4 sky;     // rgb: radiance, the mean over the upper hemisphere; w: albedo of the ground around the scene
  vec4 ground;  // rgb: radiance of that ground by the sun alone; w: part of its light that reaches surfaces
};

GLSL_END

#endif
