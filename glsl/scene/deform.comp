// Applies morph targets and skinning to the vertices of one primitive.
#include "scene/rows_of_work.glsl"
#include "shared/scene_blocks.h"

// Layouts. Undeformed vertex: position, normal, tangent, lean of smooth normals. Morph delta: the first three, without
// the tangent's handedness.
// Influences: four joints and their weights. Deformed frame: VertexFrame in C++, normal and tangent as signed 16-bit.
layout(std430, binding = 0) readonly restrict buffer Rest { float rest[]; };
layout(std430, binding = 1) readonly restrict buffer Influences { uint influences[]; };
layout(std430, binding = 2) readonly restrict buffer Deltas { float deltas[]; };
layout(std430, binding = 3) readonly restrict buffer Joints { mat4 joints[]; };
layout(std430, binding = 4) readonly restrict buffer Weights { float weights[]; };
layout(std430, binding = 5) readonly restrict buffer Jobs { DeformBlock jobs[]; };
layout(std430, binding = 6) writeonly restrict buffer Positions { float posed_positions[]; };
layout(std430, binding = 7) writeonly restrict buffer Frames { uint posed_frames[]; };

uniform int job;

vec3 rest_vector(uint at) { return vec3(rest[at], rest[at + 1u], rest[at + 2u]); }
vec3 delta_vector(uint at) { return vec3(deltas[at], deltas[at + 1u], deltas[at + 2u]); }

mat4 skin_matrix(DeformBlock block, uint vertex) {
  uint at = (block.influences + vertex) * 6u;
  uvec4 joint = uvec4(influences[at] & 0xffffu, influences[at] >> 16, influences[at + 1u] & 0xffffu,
                      influences[at + 1u] >> 16);
  joint = min(joint, uvec4(block.joint_count - 1u)) + block.joints;
  vec4 weight = uintBitsToFloat(uvec4(influences[at + 2u], influences[at + 3u], influences[at + 4u],
                                      influences[at + 5u]));
  return joints[joint.x] * weight.x + joints[joint.y] * weight.y + joints[joint.z] * weight.z +
         joints[joint.w] * weight.w;
}

vec3 safe_normalize(vec3 v) {
  float size = max(abs(v.x), max(abs(v.y), abs(v.z)));
  return size > 0.0 ? normalize(v / size) : vec3(0.0);
}

void main() {
  DeformBlock block = jobs[job];
  uint vertex = index_in_rows();
  if (vertex >= block.count) return;
  uint at = (block.source + vertex) * 11u;
  vec3 position = rest_vector(at), normal = rest_vector(at + 3u), tangent = rest_vector(at + 6u);
  float handedness = rest[at + 9u], lean = rest[at + 10u];
  for (uint i = 0u; i < block.target_count; ++i) {
    float weight = weights[block.weights + i];
    if (weight == 0.0) continue;
    uint delta = (block.deltas + i * block.count + vertex) * 9u;
    position += weight * delta_vector(delta);
    normal += weight * delta_vector(delta + 3u);
    tangent += weight * delta_vector(delta + 6u);
  }
  if (block.joint_count != 0u) {
    mat4 skin = skin_matrix(block, vertex);
    mat3 turn = mat3(skin);
    mat3 area = mat3(cross(turn[1], turn[2]), cross(turn[2], turn[0]), cross(turn[0], turn[1]));
    position = (skin * vec4(position, 1.0)).xyz;
    normal = area * normal;  // where the skin mirrors, the instance's winding flips it
    tangent = turn * tangent;
  }
  normal = safe_normalize(normal);
  tangent = safe_normalize(tangent);
  uint target = block.target + vertex;
  posed_positions[3u * target] = position.x;
  posed_positions[3u * target + 1u] = position.y;
  posed_positions[3u * target + 2u] = position.z;
  posed_frames[4u * target] = packSnorm2x16(normal.xy);
  posed_frames[4u * target + 1u] = packSnorm2x16(vec2(normal.z, lean));
  posed_frames[4u * target + 2u] = packSnorm2x16(tangent.xy);
  posed_frames[4u * target + 3u] = packSnorm2x16(vec2(tangent.z, handedness));
}
