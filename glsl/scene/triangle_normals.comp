// Computes the normals of the triangles of one deformed primitive, after deform.comp, and how far its smooth normals
// lean away from them.
#include "lib/triangle_normal.glsl"
#include "shared/scene_blocks.h"

layout(local_size_x = 64) in;

layout(std430, binding = 0) readonly restrict buffer Indices { uint indices[]; };
layout(std430, binding = 1) writeonly restrict buffer TriangleNormals { vec4 triangle_normals[]; };
layout(std430, binding = 5) readonly restrict buffer Jobs { DeformBlock jobs[]; };
layout(std430, binding = 6) readonly restrict buffer Positions { float posed_positions[]; };
layout(std430, binding = 7) readonly restrict buffer Frames { uint posed_frames[]; };

uniform int job;

vec3 corner(uint vertex) {
  return vec3(posed_positions[3u * vertex], posed_positions[3u * vertex + 1u], posed_positions[3u * vertex + 2u]);
}

vec3 smooth_normal(uint vertex) {
  return vec3(unpackSnorm2x16(posed_frames[4u * vertex]), unpackSnorm2x16(posed_frames[4u * vertex + 1u]).x);
}

void main() {
  DeformBlock block = jobs[job];
  uint triangle = gl_GlobalInvocationID.x;
  if (triangle >= block.triangle_count) return;
  uint first = block.first_index + 3u * triangle;
  uint a = block.target + indices[first];
  uint b = block.target + indices[first + 1u];
  uint c = block.target + indices[first + 2u];
  vec3 normal = triangle_normal(corner(a), corner(b), corner(c));
  float lean = smooth_lean(normal, smooth_normal(a), smooth_normal(b), smooth_normal(c));
  triangle_normals[block.first_triangle + triangle] = vec4(normal, lean);
}
