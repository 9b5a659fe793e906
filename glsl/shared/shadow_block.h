// What the shadow passes know of the view and of one light. Read by C++ and GLSL; std140, so only vec4-sized members.
#ifndef PENUMBRA_SHADOW_BLOCK_H
#define PENUMBRA_SHADOW_BLOCK_H

#include "shared/language.h"

GLSL_BEGIN

#define SHADOW_MAX_CASCADES 8
#define SHADOW_MAX_TAPS 256

struct CascadeBlock {
  vec4 map;    // xy: centre, light space, metres; z: map widths per metre; w: a texel, metres
  vec4 depth;  // x: near z, metres; y: z range, metres; z: constant bias, metres
};

struct ShadowBlock {
  mat4 clip_to_view;
  mat4 view_to_light;      // orthogonal, determinant -1 (light space is left-handed); its origin is the camera
  mat4 world_to_light;     // its turn alone
  mat4 view_to_last_clip;  // from this frame's view space
  mat4 last_clip_to_view;  // and back
  vec4 viewport;           // xy: its lowest pixel; zw: size, pixels
  vec4 jitter;             // NDC; xy: of this frame; zw: of the last one
  vec4 depth_to_ndc;       // x: scale; y: offset; z: depth of the sky; w: 1 for octahedral normals, 0 for xyz
  vec4 pixel_size;         // xy: metres that a pixel spans where clip w is 1; zw: clip w is z · view z + w
  vec4 light;              // x: tan of the half angle; y: 1: square light, 0: disc; z: cascades; w: map size, texels
  vec4 noise_shift;        // on the torus; xy: of the blocker step; zw: of the filter step
  // 1 or 0, x: the last frame's shadow is valid; y: there are motion vectors; z: casters moved, and the movement map
  // shows where; w: least depth of what moved, light space, metres.
  vec4 history;
  CascadeBlock cascades[SHADOW_MAX_CASCADES];
};

// Sample points, two to a vec4: on the unit disc when rotated by a pixel, on the unit square when shifted.
struct SampleBlock {
  vec4 blocker[SHADOW_MAX_TAPS / 2];
  vec4 filter_points[SHADOW_MAX_TAPS / 2];
  vec4 renewal_points[SHADOW_MAX_TAPS / 2];  // the filter's, where the history is refused
};

GLSL_END

#endif
