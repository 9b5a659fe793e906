// The camera, for passes that draw geometry. Shared by C++ and GLSL; std140.
#ifndef PENUMBRA_VIEW_BLOCK_H
#define PENUMBRA_VIEW_BLOCK_H

#include "shared/language.h"

GLSL_BEGIN

struct ViewBlock {
  mat4 world_to_clip;
  mat4 last_world_to_clip;
  vec4 camera;    // xyz: position, world, metres; w: 1 for orthographic
  vec4 forward;   // xyz: direction of the picture's middle, 1 m along the view's axis, world; w: near plane, metres
  vec4 ray_x;     // xyz: the ray through NDC (x, y) is forward + x ray_x + y ray_y; 0 if orthographic
  vec4 ray_y;     // xyz: see ray_x
  vec4 viewport;  // xy: size, pixels; zw: its reciprocal
};

GLSL_END

#endif
