// The uniforms of the shadow passes: the view and one light. Shared by C++ and GLSL; std140.
#ifndef PENUMBRA_SHADOW_BLOCK_H
#define PENUMBRA_SHADOW_BLOCK_H

#include "shared/language.h"

GLSL_BEGIN

#define SHADOW_MAX_LAYERS 8

// The placement of one layer of a light's shadow map, and the range of its depths. Only
// glsl/shadow/projection reads it. A lamp's are tangents instead of metres across, and −1 / depth along.
struct LayerBlock {
  vec2 center;            // of the map, light space, metres
  vec2 widths_per_metre;  // map widths and heights
  vec2 texel_shares;      // width and height of a texel over the larger of both
  float texel;            // the larger of both, metres
  float near_depth;       // light-space depth that the map stores as 0, metres
  float depth_range;      // from near_depth to the depth that the map stores as 1, metres
  float rounding;         // bias along the light that covers rounding, metres
  float texel_uv;         // width of a texel in texture coordinates
  float position_rounding;  // the same for rounding of positions in the world, metres also of a lamp
};

struct ShadowBlock {
  mat4 clip_to_view;
  mat4 view_to_light;      // orthogonal, determinant -1 (light space is left-handed)
  mat4 world_to_light;     // the rotation part of view_to_light, from world space
  mat4 view_to_last_clip;  // from this frame's view space
  mat4 last_clip_to_view;  // and back
  vec4 viewport;           // xy: its lowest pixel; zw: size, pixels
  vec4 jitter;             // NDC; xy: of this frame; zw: of the last one
  vec4 pixel_size;         // xy: metres that a pixel spans where clip w is 1; zw: clip w is z · view z + w
  vec4 noise_shift;        // toroidal shift of the noise's values; xy: blocker step; zw: filter step
  ivec4 noise_place[2];    // of both steps; xy: pixels added to the pixel's; z: frame of the noise texture; w: of keys
  vec2 depth_to_ndc;       // x: scale; y: offset
  vec2 normal_decode;      // x: scale; y: offset: from what the normals texture holds to -1..1
  vec2 depth_error;        // most error of a receiver's NDC depth: x: absolute; y: times its absolute value
  float sky_depth;         // stored depth of pixels that show nothing
  int octahedral_normals;  // 1: normals are octahedral; 0: xyz
  float light_extent;      // see Light::extent in shadow/projection
  int light_is_square;     // 1: square; 0: disc
  int layer_count;         // of the shadow map
  float map_size;          // side of each layer, texels
  int history_valid;       // 1: the last frame's history is valid
  int has_motion;          // 1: the caller brings motion vectors
  int casters_moved;       // 1: casters moved, and the movement map shows where
  float moved_depth;       // least light-space depth of what moved, metres; of a lamp: along a face's axis, above 0
  vec2 axes_turn;          // cosine and sine of the angle by which the light's x and y axes are turned in this frame
  float light_stretch;     // most times that a disc which faces a receiver is longer along the map than across
  int light_is_lamp;       // 1: a lamp; 0: a sun
  float lamp_range;        // of a lamp: distance to which it shines, metres
  int normals_from_depth;  // 1: the caller brings no normals: they were made from depths
  float vertex_rounding;   // pixels along each axis by which the rasteriser may have moved the receivers' vertices
  int maps_are_moved;      // 1: the last frame or sample had them elsewhere within a texel, and a mean is taken
  vec4 lamp;               // xyz: its centre, view space, metres; w: the cosine of its cone's half angle
  // The layer that contains every caster; apart from `layers`, because a load at an index costs more.
  LayerBlock widest;
  LayerBlock layers[SHADOW_MAX_LAYERS];
};

GLSL_END

#endif
