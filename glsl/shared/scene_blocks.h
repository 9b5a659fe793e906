// The scene's data in shader buffers. Shared by C++ and GLSL; std430, but std140 for the material.
#ifndef PENUMBRA_SCENE_BLOCKS_H
#define PENUMBRA_SCENE_BLOCKS_H

#include "shared/language.h"

GLSL_BEGIN

// One instance of a primitive.
struct InstanceBlock {
  mat4 world;
  mat4 last_world;   // in the last frame
  mat4 area;         // cofactor matrix of world: transforms cross products, and so normals
  uint first_index;     // of the primitive, in the index buffer
  uint base_vertex;     // added to each index
  uint first_triangle;  // of the primitive, in the buffer of triangle normals
  float winding;        // -1 for mirrored instances, else 1
};

// Textures of a material, in the order of their units.
#define TEXTURE_BASE_COLOR 0
#define TEXTURE_METALLIC_ROUGHNESS 1
#define TEXTURE_NORMAL 2
#define TEXTURE_OCCLUSION 3
#define TEXTURE_EMISSIVE 4
#define TEXTURE_COUNT 5

// MaterialBlock::flags: bit i: texture i uses the second UV set.
#define MATERIAL_UNLIT 0x10000u

struct MaterialBlock {
  vec4 base_color;
  vec3 emissive;
  float alpha_cutoff;  // lower alpha is discarded; blended materials: lower alpha casts no shadow
  float metallic;
  float roughness;
  float normal_scale;
  float occlusion_strength;  // 0 without that texture
  // 1 if the material has the texture, else 0: its program may serve materials with more of them.
  float has_base_color;
  float has_metallic_roughness;
  float has_emissive;
  uint flags;
  vec4 uv_rows[TEXTURE_COUNT * 2];  // two rows a texture: u' and v' as factors of u, v, 1
  vec4 pad_d[2];                    // to 256 bytes, where every driver lets a uniform block begin
};

// One primitive to be skinned or morphed. Counts are in vertices, offsets in elements of their buffers.
struct DeformBlock {
  uint source;      // first vertex of the undeformed primitive
  uint target;      // first vertex of the deformed result
  uint count;
  uint influences;  // first joint record; only with joints
  uint joints;      // first joint matrix
  uint joint_count; // 0: not skinned
  uint deltas;      // first morph delta: targets one after the other, `count` each
  uint weights;     // first morph weight
  uint target_count;
  uint first_index;     // of the primitive, in the index buffer
  uint first_triangle;  // of the result, in the deformed triangle normals
  uint triangle_count;
};

GLSL_END

#endif
