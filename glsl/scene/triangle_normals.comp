// Computes the normals of the triangles of one deformed primitive, after deform.comp.
#include "lib/triangle_normal.glsl"
#include "scene/rows_of_work.glsl"
#include "shared/scene_blocks.h"

layout(std430, binding = 0) readonly restrict buffer Indices { uint indices[]; };
layout(std430, binding = 1) writeonly restrict buffer TriangleNormals { float triangle_normals[]; };
layout(std430, binding = 5) readonly restrict buffer Jobs { DeformBlock jobs[]; };
layout(std430, binding = 6) readonly restrict buffer Positions { float posed_positions[]; };

uniform int job;

vec3 corner(uint vertex) {
  return vec3(posed_positions[3u * vertex], posed_positions[3u * vertex + 1u], posed_positions[3u * vertex + 2u]);
}

void main() {
  DeformBlock block = jobs[job];
  uint triangle = index_in_rows();
  if (triangle >= block.triangle_count) return;
  uint first = block.first_index + 3u * triangle;
  vec3 normal = triangle_normal(corner(block.target + indices[first]), corner(block.target + indices[first + 1u]),
                                corner(block.target + indices[first + 2u]));
  uint at = 3u * (block.first_triangle + triangle);
  triangle_normals[at] = normal.x;
  triangle_normals[at + 1u] = normal.y;
  triangle_normals[at + 2u] = normal.z;
}
