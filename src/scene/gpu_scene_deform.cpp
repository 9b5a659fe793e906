#include "scene/gpu_scene_deform.h"

#include <algorithm>
#include <bit>
#include <cassert>

#include "scene/gpu_scene_boxes.h"
#include "scene/smooth_lean.h"

namespace penumbra::scene {

namespace {

// Must match glsl/scene/deform.comp and triangle_normals.comp, which share the last ones but one.
enum Binding : GLuint {
  binding_rest,
  binding_influences,
  binding_deltas,
  binding_joints,
  binding_weights,
  binding_jobs,
  binding_positions,
  binding_frames,
  // Of triangle_normals.comp alone.
  binding_indices = 0,
  binding_triangle_normals = 1,
};

gl::ProgramDesc vertex_program() { return {.name = "deform", .compute = "scene/deform.comp"}; }
gl::ProgramDesc triangle_program() { return {.name = "triangle normals", .compute = "scene/triangle_normals.comp"}; }

void append(std::vector<float>& to, const glm::vec3& v) { to.insert(to.end(), {v.x, v.y, v.z}); }

// Of a vertex; must match glsl/scene/deform.comp.
constexpr std::size_t rest_floats = 11, influence_words = 6, delta_floats = 9;

void append_rest(std::vector<float>& rest, const Primitive& primitive) {
  const std::vector<float> leans = smooth_leans(primitive);
  for (std::size_t i = 0; i < primitive.positions.size(); ++i) {
    append(rest, primitive.positions[i]);
    append(rest, primitive.normals[i]);
    const glm::vec4 tangent = primitive.tangents.empty() ? glm::vec4(0.0f) : primitive.tangents[i];
    append(rest, glm::vec3(tangent));
    rest.push_back(tangent.w < 0.0f ? -1.0f : 1.0f);
    rest.push_back(leans[i]);
    assert(rest.size() % rest_floats == 0);
  }
}

void append_influences(std::vector<std::uint32_t>& influences, const Primitive& primitive) {
  for (std::size_t i = 0; i < primitive.joints.size(); ++i) {
    const glm::u16vec4& joint = primitive.joints[i];
    influences.push_back(joint.x | static_cast<std::uint32_t>(joint.y) << 16);
    influences.push_back(joint.z | static_cast<std::uint32_t>(joint.w) << 16);
    for (glm::length_t k = 0; k < 4; ++k) influences.push_back(std::bit_cast<std::uint32_t>(primitive.weights[i][k]));
  }
}

void append_deltas(std::vector<float>& deltas, const Primitive& primitive) {
  const auto delta = [](const std::vector<glm::vec3>& list, std::size_t i) {
    return list.empty() ? glm::vec3(0.0f) : list[i];
  };
  for (const MorphTarget& target : primitive.targets) {
    for (std::size_t i = 0; i < primitive.positions.size(); ++i) {
      append(deltas, delta(target.positions, i));
      append(deltas, delta(target.normals, i));
      append(deltas, delta(target.tangents, i));
    }
  }
}

// The box of the vertices that each joint moves, empty where it moves none; without a skin, of all vertices.
std::vector<Bounds> bounds_by_joint(const Primitive& primitive, bool skinned) {
  std::vector<Bounds> boxes(1);
  for (std::size_t i = 0; i < primitive.positions.size(); ++i) {
    if (!skinned) {
      boxes[0].add(primitive.positions[i]);
      continue;
    }
    for (glm::length_t k = 0; k < 4; ++k) {
      if (primitive.weights[i][k] == 0.0f) continue;
      const std::size_t joint = primitive.joints[i][k];
      if (joint >= boxes.size()) boxes.resize(joint + 1);
      boxes[joint].add(primitive.positions[i]);
    }
  }
  return boxes;
}

glm::vec3 largest_offset(const MorphTarget& target) {
  glm::vec3 offset(0.0f);
  for (const glm::vec3& delta : target.positions) offset = glm::max(offset, glm::abs(delta));
  return offset;
}

float weight_of(const Pose& pose, int node, std::size_t target) {
  const auto& weights = pose.weights[static_cast<std::size_t>(node)];
  return target < weights.size() ? weights[target] : 0.0f;
}

constexpr int row = 1 << 16;  // invocations: see glsl/scene/rows_of_work.glsl

void dispatch(gl::Pass& pass, std::uint32_t count) {
  const auto all = static_cast<int>(count);
  if (all > 0) pass.dispatch(std::min(all, row), (all + row - 1) / row);
}

}  // namespace

bool Deformer::skins(const Node& node, const Primitive& primitive) {
  return node.skin >= 0 && !primitive.joints.empty();
}

bool Deformer::deforms(const Node& node, const Primitive& primitive) {
  return !primitive.targets.empty() || skins(node, primitive);
}

std::size_t Deformer::source_bytes(const Primitive& primitive, bool skinned) {
  const std::size_t floats = rest_floats + (skinned ? influence_words : 0) + primitive.targets.size() * delta_floats;
  return primitive.positions.size() * floats * sizeof(float);
}

const Deformer::Source& Deformer::source_of(const Primitive& primitive, bool skinned) {
  const auto [entry, added] = sources_.try_emplace({&primitive, skinned});
  Source& source = entry->second;
  if (!added) return source;
  source = {.vertices = static_cast<std::uint32_t>(rest_.size() / rest_floats),
            .influences = static_cast<std::uint32_t>(influences_.size() / influence_words),
            .deltas = static_cast<std::uint32_t>(deltas_.size() / delta_floats)};
  const std::vector<Bounds> boxes = bounds_by_joint(primitive, skinned);
  for (std::uint32_t joint = 0; joint < boxes.size(); ++joint)
    if (!boxes[joint].empty) source.parts.push_back({.joint = joint, .box = boxes[joint]});
  for (const MorphTarget& morph : primitive.targets) source.offsets.push_back(largest_offset(morph));
  append_rest(rest_, primitive);
  if (skinned) append_influences(influences_, primitive);
  append_deltas(deltas_, primitive);
  return source;
}

Deformer::NodeInputs Deformer::inputs_of(const Scene& scene, int node) {
  if (!nodes_.empty() && nodes_.back().node == node) return nodes_.back();
  const Node& described = scene.nodes[static_cast<std::size_t>(node)];
  std::size_t targets = 0;
  for (const Primitive& primitive : scene.meshes[static_cast<std::size_t>(described.mesh)].primitives)
    targets = std::max(targets, primitive.targets.size());
  nodes_.push_back({.node = node, .joints = joints_, .weights = weights_, .weight_count = targets});
  if (described.skin >= 0)
    joints_ += static_cast<std::uint32_t>(scene.skins[static_cast<std::size_t>(described.skin)].joints.size());
  weights_ += static_cast<std::uint32_t>(targets);
  return nodes_.back();
}

int Deformer::add(const Scene& scene, int node, const Primitive& primitive, const Place& place) {
  const Node& described = scene.nodes[static_cast<std::size_t>(node)];
  const bool skinned = skins(described, primitive);
  const std::size_t joints = skinned ? scene.skins[static_cast<std::size_t>(described.skin)].joints.size() : 0;
  const auto triangles =
      primitive.topology == Topology::triangles ? static_cast<std::uint32_t>(primitive.indices.size() / 3) : 0u;
  const Source& source = source_of(primitive, skinned);
  const NodeInputs inputs = inputs_of(scene, node);
  jobs_.push_back({.node = node,
                   .source = &source,
                   .block = {.source = source.vertices,
                             .target = place.first_vertex,
                             .count = static_cast<std::uint32_t>(primitive.positions.size()),
                             .influences = source.influences,
                             .joints = inputs.joints,
                             .joint_count = static_cast<std::uint32_t>(joints),
                             .deltas = source.deltas,
                             .weights = inputs.weights,
                             .target_count = static_cast<std::uint32_t>(primitive.targets.size()),
                             .first_index = place.first_index,
                             .first_triangle = place.first_triangle,
                             .triangle_count = triangles}});
  return static_cast<int>(jobs_.size()) - 1;
}

void Deformer::upload() {
  std::vector<glsl::DeformBlock> blocks;
  for (const Job& job : jobs_) blocks.push_back(job.block);
  rest_buffer_ = gl::Buffer::of("rest vertices", std::span<const float>(rest_));
  influence_buffer_ = gl::Buffer::of("joint influences", std::span<const std::uint32_t>(influences_));
  delta_buffer_ = gl::Buffer::of("morph deltas", std::span<const float>(deltas_));
  job_buffer_ = gl::Buffer::of("deform jobs", std::span<const glsl::DeformBlock>(blocks));
  rest_ = {};
  influences_ = {};
  deltas_ = {};
}

bool Deformer::mirrored(int job, const Pose& pose) const {
  const Job& own = jobs_[static_cast<std::size_t>(job)];
  const auto node = static_cast<std::size_t>(own.node);
  return is_mirror(own.block.joint_count != 0 ? pose.skin[node][0] : pose.world[node]);
}

bool Deformer::differs(int job, const Pose& a, const Pose& b) const {
  const auto node = static_cast<std::size_t>(jobs_[static_cast<std::size_t>(job)].node);
  return a.weights[node] != b.weights[node] || (skinned(job) && a.skin[node] != b.skin[node]);
}

Bounds Deformer::bounds(int job, const Pose& pose) const {
  const Job& own = jobs_[static_cast<std::size_t>(job)];
  glm::vec3 offset(0.0f);
  const Source& source = *own.source;
  for (std::size_t i = 0; i < source.offsets.size(); ++i)
    offset += std::abs(weight_of(pose, own.node, i)) * source.offsets[i];
  Bounds bounds;
  for (const auto& [joint, box] : source.parts) {
    Bounds part = box;
    part.add(part.min - offset);
    part.add(part.max + offset);
    if (!skinned(job)) {
      bounds.add(part);
      continue;
    }
    // A skinned vertex is a weighted mean of its positions under each joint, so it is inside the union of the boxes.
    const std::vector<glm::mat4>& joints = pose.skin[static_cast<std::size_t>(own.node)];
    bounds.add(transformed(part, joints[std::min<std::size_t>(joint, joints.size() - 1)]));
  }
  return bounds;
}

void Deformer::run(gl::Device& device, const Pose& pose, const gl::Buffer& indices, const Results& results) const {
  if (jobs_.empty()) return;
  std::vector<glm::mat4> joints;
  std::vector<float> weights;
  for (const NodeInputs& inputs : nodes_) {
    const std::vector<glm::mat4>& skin = pose.skin[static_cast<std::size_t>(inputs.node)];
    joints.insert(joints.end(), skin.begin(), skin.end());
    for (std::size_t i = 0; i < inputs.weight_count; ++i) weights.push_back(weight_of(pose, inputs.node, i));
  }
  assert(joints.size() == joints_ && weights.size() == weights_);
  const gl::Buffer& joint_buffer = device.scratch("joint matrices", joints.size() * sizeof(glm::mat4) + 1);
  const gl::Buffer& weight_buffer = device.scratch("morph weights", weights.size() * sizeof(float) + 1);
  joint_buffer.write(std::as_bytes(std::span(joints)));
  weight_buffer.write(std::as_bytes(std::span(weights)));

  gl::Pass pass(device, {.name = "deform"});
  const gl::Program& deform = pass.use(vertex_program());
  rest_buffer_.bind_storage(binding_rest);
  influence_buffer_.bind_storage(binding_influences);
  delta_buffer_.bind_storage(binding_deltas);
  joint_buffer.bind_storage(binding_joints);
  weight_buffer.bind_storage(binding_weights);
  job_buffer_.bind_storage(binding_jobs);
  results.positions.bind_storage(binding_positions);
  results.frames.bind_storage(binding_frames);
  for (std::size_t i = 0; i < jobs_.size(); ++i) {
    deform.set("job", static_cast<int>(i));
    dispatch(pass, jobs_[i].block.count);
  }
  const gl::Program& normals = pass.use(triangle_program());
  indices.bind_storage(binding_indices);
  results.triangle_normals.bind_storage(binding_triangle_normals);
  for (std::size_t i = 0; i < jobs_.size(); ++i) {
    normals.set("job", static_cast<int>(i));
    dispatch(pass, jobs_[i].block.triangle_count);
  }
}

std::vector<gl::ProgramDesc> Deformer::programs() { return {vertex_program(), triangle_program()}; }

}  // namespace penumbra::scene
