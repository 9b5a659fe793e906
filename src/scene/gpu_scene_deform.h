#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "gl/buffer.h"
#include "gl/pass.h"
#include "scene/gpu_scene_vertices.h"
#include "scene/pose.h"
#include "scene/scene.h"
#include "shared/scene_blocks.h"

namespace penumbra::scene {

// Skinning and morphing of a scene: one job for each primitive of each deforming node. Morphed vertices stay in their
// node's space; skinned vertices are written in world space.
class Deformer {
 public:
  static bool deforms(const Node& node, const Primitive& primitive);
  // Whether the node's skin moves the primitive.
  static bool skins(const Node& node, const Primitive& primitive);
  // Of an undeformed primitive on the GPU, in the buffers of the deformer. Nodes that draw it share it, apart from
  // those that skin it and those that don't.
  static std::size_t source_bytes(const Primitive& primitive, bool skinned);

  // Where a job finds the indices of its primitive, and where its results begin.
  struct Place {
    std::uint32_t first_index = 0, first_vertex = 0, first_triangle = 0;
  };

  // Adds a job; returns its number. Jobs of a node share what they read of its pose if they are added one after the
  // other. Call upload() once after the last add().
  int add(const Scene& scene, int node, const Primitive& primitive, const Place& place);
  void upload();

  bool skinned(int job) const { return jobs_[static_cast<std::size_t>(job)].block.joint_count != 0; }
  // Whether the job's matrices turn counter-clockwise triangles clockwise.
  bool mirrored(int job, const Pose& pose) const;
  bool differs(int job, const Pose& a, const Pose& b) const;
  // The bounding box of the deformed vertices, in the space in which they are written.
  Bounds bounds(int job, const Pose& pose) const;

  // Where the results are written to.
  struct Results {
    const gl::Buffer& positions;
    const gl::Buffer& frames;
    const gl::Buffer& triangle_normals;
  };
  // Runs all jobs for a pose.
  void run(gl::Device& device, const Pose& pose, const gl::Buffer& indices, const Results& results) const;

  static std::vector<gl::ProgramDesc> programs();

 private:
  struct Part {
    std::uint32_t joint = 0;
    Bounds box;
  };

  // An undeformed primitive.
  struct Source {
    std::uint32_t vertices = 0, influences = 0, deltas = 0;  // offsets of the first element of each
    std::vector<Part> parts;  // box of the undeformed vertices that each joint moves; without a skin a single one
    std::vector<glm::vec3> offsets;  // per morph target: the most that it moves any vertex
  };

  struct Job {
    int node = -1;
    const Source* source = nullptr;
    glsl::DeformBlock block{};
  };

  // What the jobs of a node read of its pose: offsets of the first joint matrix and weight, and the number of weights.
  struct NodeInputs {
    int node = -1;
    std::uint32_t joints = 0, weights = 0;
    std::size_t weight_count = 0;
  };

  const Source& source_of(const Primitive& primitive, bool skinned);
  NodeInputs inputs_of(const Scene& scene, int node);

  std::map<std::pair<const Primitive*, bool>, Source> sources_;  // by primitive, and whether it is skinned
  std::vector<Job> jobs_;
  std::vector<NodeInputs> nodes_;
  std::uint32_t joints_ = 0, weights_ = 0;
  std::vector<float> rest_, deltas_;
  std::vector<std::uint32_t> influences_;
  gl::Buffer rest_buffer_, influence_buffer_, delta_buffer_, job_buffer_;
};

}  // namespace penumbra::scene
