#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "scene/gpu_scene.h"
#include "scene/gpu_scene_deform.h"
#include "scene/gpu_scene_materials.h"
#include "scene/gpu_scene_vertices.h"
#include "scene/mesh_parts.h"
#include "scene/posed_geometry.h"
#include "scene/surface_traits.h"

namespace penumbra::scene {

// A primitive at one place. Instances of the same primitive are consecutive, so that one draw covers them.
struct Instance {
  const Primitive* primitive = nullptr;
  int node = -1;
  int copy = -1;  // index of the EXT_mesh_gpu_instancing instance; -1: none
  int job = -1;   // the deformer's job; -1: none
  Topology topology = Topology::triangles;
  AlphaMode alpha_mode = AlphaMode::opaque;
  CastMode casts = CastMode::always;
  int material = 0;
  SurfaceTraits traits;
  bool double_sided = false;
  // Which faces cast shadows by the present choice of casters; nothing if none does.
  std::optional<CasterFaces> faces = CasterFaces::both;
  std::uint32_t first_index = 0, index_count = 0, base_vertex = 0, first_triangle = 0;
  Bounds local;                                  // bounds in node space, unless it deforms
  const std::vector<MeshPart>* parts = nullptr;  // of a large mesh that does not deform

  // In the present pose.
  glm::mat4 world{1};
  bool mirrored = false, moved = false;
  Bounds box, last_box;
};

// A run of instances that are drawn with the same state.
struct Batch {
  bool deformed = false, mirrored = false, double_sided = false;
  Topology topology = Topology::triangles;
  int material = -1;        // -1: the draw reads no material
  bool alpha_only = false;  // of the material, only the alpha that cuts a caster out
  SurfaceTraits traits;
  std::size_t first = 0, count = 0;

  bool same_state(const Batch& other) const;
};

struct DrawList {
  std::vector<gl::DrawElementsCommand> commands;
  std::vector<Batch> batches;

  void add(const Instance& instance, std::uint32_t index, const Batch& batch);
  void add_part(const Instance& instance, std::uint32_t index, const Batch& batch, const MeshPart& part);

 private:
  bool begin(Batch batch);  // whether the batch is a new one
};

// Consecutive instances of one primitive.
struct Run {
  std::uint32_t first = 0, last = 0;
  float distance = 0;  // of the nearest
};

// Which casters a draw includes, and what it writes.
struct CasterDraw {
  bool still = false, moved = false;
  bool marks = false;                // writes 1 to fragment output 0
  bool last_pose = false;            // draws the last pose instead of the present one
  std::optional<float> behind = {};  // what may lie behind other casters: writes depths + that gap to output 0
  bool anchored = true;              // positions are taken less an anchor
};

// What the program that draws a surface's depth depends on. Nothing unless an alpha test cuts parts out of it.
SurfaceTraits depth_traits(const Instance& instance, bool masked);
// The program that draws the depth of casters as `which` says, where their alpha passes if they are masked.
gl::ProgramDesc caster_program(const CasterDraw& which, const SurfaceTraits& traits);

// A pose on the GPU: the deformed vertices at one time.
struct PosedVertices {
  std::optional<double> time;
  std::uint64_t shader_changes = 0;  // that the device had seen when they were computed
  Pose pose;
  gl::Buffer positions, frames, triangle_normals;

  bool show(const gl::Device& device, double at) const {
    return time == at && shader_changes == device.shaders.changes();
  }
};

struct GpuScene::State {
  State(gl::Device& device, const Scene& scene);

  const Scene& scene;
  const std::uint64_t id;
  Materials materials;
  Deformer deformer;
  std::map<const Primitive*, std::vector<MeshPart>> parts;
  std::vector<Instance> instances;
  gl::Buffer positions, frames, surfaces, indices, triangle_normals;  // of all primitives, undeformed
  gl::Buffer deformed_surfaces;
  gl::Buffer instance_numbers, instance_blocks;
  VertexArray rigid{"rigid vertices"}, deformed{"deformed vertices"}, unindexed{"instance numbers", /*vertices=*/false};

  std::array<PosedVertices, 2> posed;
  const PosedVertices* now = nullptr;
  const PosedVertices* last = nullptr;
  std::pair<double, double> times;  // of the last and the present pose

  CasterChoice choice;
  bool moved = false, blended = false, emissive = false, lit_by_file = false;
  Bounds casters, receivers, blended_receivers, moved_casters;

  PosedVertices& posed_at(gl::Device& device, double time, const PosedVertices* keep);
  void set_vertex_arrays() const;
  void update_instances();
  std::size_t most_commands() const;  // of a draw of all instances, in parts
  void choose_faces();
  void update_caster_bounds();
  // `use`: called with the traits of the batches that follow, where they differ from those before; absent: the caller
  // has chosen a program.
  void draw(gl::Device& device, gl::Pass& pass, const DrawList& list, const UseProgram& use = {}) const;
  // For vertex shaders that read the index buffer themselves.
  void draw_unindexed(gl::Device& device, gl::Pass& pass, const DrawList& list) const;
  std::vector<Run> nearest_first(AlphaMode mode, const BoxTest& visible, const Distance& distance) const;
  void draw_casters(gl::Device& device, gl::Pass& pass, const CasterDraw& which, const CasterMatrix& matrix,
                    const BoxOverlap& reaches) const;
  DrawList caster_geometry(std::optional<CasterFaces> faces, const BoxTest& reaches) const;
};

}  // namespace penumbra::scene
