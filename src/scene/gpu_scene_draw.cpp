// Which instances a pass draws, in which order, with which state.
#include <algorithm>
#include <numeric>

#include "scene/gpu_scene.h"
#include "scene/gpu_scene_state.h"

namespace penumbra::scene {

namespace {

// Must match glsl/scene.
constexpr GLuint instances_binding = 0;
constexpr GLuint triangle_normals_binding = 2;
constexpr GLuint indices_binding = 2;
constexpr GLuint positions_binding = 3;

GLenum mode_of(Topology topology) {
  switch (topology) {
    case Topology::points:
      return GL_POINTS;
    case Topology::lines:
      return GL_LINES;
    case Topology::triangles:
      break;
  }
  return GL_TRIANGLES;
}

// The state that shading reads of an instance.
Batch shaded_batch(const Instance& instance) {
  return {.deformed = instance.job >= 0,
          .mirrored = instance.mirrored,
          .double_sided = instance.double_sided || instance.topology != Topology::triangles,
          .topology = instance.topology,
          .material = instance.material,
          .traits = instance.traits};
}

// The same, as far as only depth is drawn.
Batch depth_batch(const Instance& instance, bool masked) {
  Batch batch = shaded_batch(instance);
  batch.traits = depth_traits(instance, masked);
  if (!masked) batch.material = -1;
  return batch;
}

// The same draws for a vertex shader that reads the index buffer itself, at gl_VertexID.
std::vector<gl::DrawArraysCommand> without_indices(std::span<const gl::DrawElementsCommand> commands) {
  std::vector<gl::DrawArraysCommand> result;
  for (const gl::DrawElementsCommand& command : commands)
    result.push_back({command.index_count, command.instance_count, command.first_index, command.base_instance});
  return result;
}

std::size_t triangles_of(const DrawList& list, const Batch& batch) {
  std::size_t triangles = 0;
  for (std::size_t i = batch.first; i < batch.first + batch.count; ++i)
    triangles += std::size_t{list.commands[i].index_count} / 3 * list.commands[i].instance_count;
  return triangles;
}

}  // namespace

bool Batch::same_state(const Batch& other) const {
  return deformed == other.deformed && mirrored == other.mirrored && double_sided == other.double_sided &&
         topology == other.topology && material == other.material && traits == other.traits;
}

bool DrawList::begin(Batch batch) {
  if (!batches.empty() && batches.back().same_state(batch)) return false;
  batch.first = commands.size();
  batches.push_back(batch);
  return true;
}

void DrawList::add(const Instance& instance, std::uint32_t index, const Batch& batch) {
  const bool new_batch = begin(batch);
  const auto base_vertex = static_cast<std::int32_t>(instance.base_vertex);
  if (!new_batch) {
    gl::DrawElementsCommand& previous = commands.back();
    if (previous.first_index == instance.first_index && previous.index_count == instance.index_count &&
        previous.base_vertex == base_vertex && previous.base_instance + previous.instance_count == index) {
      ++previous.instance_count;
      return;
    }
  }
  commands.push_back({instance.index_count, 1, instance.first_index, base_vertex, index});
  ++batches.back().count;
}

void DrawList::add_part(const Instance& instance, std::uint32_t index, const Batch& batch, const MeshPart& part) {
  const bool new_batch = begin(batch);
  const std::uint32_t first = instance.first_index + part.first_index;
  if (!new_batch) {
    gl::DrawElementsCommand& previous = commands.back();
    if (previous.base_instance == index && previous.instance_count == 1 &&
        previous.first_index + previous.index_count == first) {
      previous.index_count += part.index_count;
      return;
    }
  }
  commands.push_back({part.index_count, 1, first, static_cast<std::int32_t>(instance.base_vertex), index});
  ++batches.back().count;
}

// A camera that moves never needs a larger buffer.
std::size_t GpuScene::State::most_commands() const {
  std::size_t most = 0;
  for (const Instance& instance : instances) most += instance.parts != nullptr ? instance.parts->size() : 1;
  return most;
}

void GpuScene::State::draw(gl::Device& device, gl::Pass& pass, const DrawList& list, const UseProgram& use) const {
  if (list.commands.empty()) return;
  const auto bytes = std::as_bytes(std::span(list.commands));
  const gl::Buffer& commands = device.scratch("draw commands", most_commands() * sizeof(gl::DrawElementsCommand));
  commands.write(bytes);
  instance_blocks.bind_storage(instances_binding);
  const SurfaceTraits* used = nullptr;
  for (const Batch& batch : list.batches) {
    if (use && (used == nullptr || *used != batch.traits)) use(batch.traits);
    used = &batch.traits;
    (batch.deformed ? deformed : rigid).bind();
    (batch.deformed ? now->triangle_normals : triangle_normals).bind_storage(triangle_normals_binding);
    pass.set_cull_back(!batch.double_sided);
    pass.set_front_clockwise(batch.mirrored);
    if (batch.material >= 0) {
      batch.alpha_only ? materials.bind_alpha(batch.material) : materials.bind(batch.material);
    }
    const std::size_t offset = batch.first * sizeof(gl::DrawElementsCommand);
    pass.draw_elements_indirect(mode_of(batch.topology), GL_UNSIGNED_INT, {commands, offset, batch.count});
    pass.count_draws(0, batch.topology == Topology::triangles ? triangles_of(list, batch) : 0);
  }
}

void GpuScene::State::draw_unindexed(gl::Device& device, gl::Pass& pass, const DrawList& list) const {
  if (list.commands.empty()) return;
  const std::vector<gl::DrawArraysCommand> draws = without_indices(list.commands);
  const auto bytes = std::as_bytes(std::span(draws));
  const gl::Buffer& commands = device.scratch("draw commands", most_commands() * sizeof(gl::DrawElementsCommand));
  commands.write(bytes);
  instance_blocks.bind_storage(instances_binding);
  indices.bind_storage(indices_binding);
  unindexed.bind();
  for (const Batch& batch : list.batches) {
    (batch.deformed ? now->positions : positions).bind_storage(positions_binding);
    pass.set_cull_back(!batch.double_sided);
    pass.set_front_clockwise(batch.mirrored);
    const std::size_t offset = batch.first * sizeof(gl::DrawArraysCommand);
    pass.draw_arrays_indirect(mode_of(batch.topology), {commands, offset, batch.count});
    pass.count_draws(0, batch.topology == Topology::triangles ? triangles_of(list, batch) : 0);
  }
}

// The visible surfaces of a mode, nearest first. Copies of one primitive stay together, because one draw covers them.
std::vector<Run> GpuScene::State::nearest_first(AlphaMode mode, const BoxTest& visible,
                                                const Distance& distance) const {
  std::vector<Run> runs;
  for (std::uint32_t i = 0; i < instances.size(); ++i) {
    const Instance& instance = instances[i];
    if (instance.alpha_mode != mode || !visible(instance.box)) continue;
    const float away = distance(instance.box);
    const bool copy = !runs.empty() && runs.back().last + 1 == i && instances[i - 1].primitive == instance.primitive &&
                      instances[i - 1].base_vertex == instance.base_vertex;
    if (copy) {
      runs.back().last = i;
      runs.back().distance = std::min(runs.back().distance, away);
    } else {
      runs.push_back({.first = i, .last = i, .distance = away});
    }
  }
  std::ranges::stable_sort(runs, {}, &Run::distance);
  return runs;
}

void GpuScene::draw_depth(gl::Device& device, gl::Pass& pass, const glm::mat4& world_to_clip, const BoxTest& visible,
                          const Distance& distance) {
  for (const bool masked : {false, true}) {
    DrawList list;
    const AlphaMode mode = masked ? AlphaMode::mask : AlphaMode::opaque;
    for (const Run& run : state_->nearest_first(mode, visible, distance)) {
      for (std::uint32_t i = run.first; i <= run.last; ++i)
        list.add(state_->instances[i], i, depth_batch(state_->instances[i], masked));
    }
    if (list.commands.empty()) continue;
    const auto use = [&](const SurfaceTraits& traits) {
      pass.use(caster_program({.anchored = false}, traits)).set("world_to_clip", world_to_clip);
    };
    state_->draw(device, pass, list, use);
  }
}

void GpuScene::draw_surfaces(gl::Device& device, gl::Pass& pass, const UseProgram& use, const BoxTest& visible) {
  DrawList list;
  for (std::uint32_t i = 0; i < state_->instances.size(); ++i) {
    const Instance& instance = state_->instances[i];
    if (instance.alpha_mode != AlphaMode::blend && visible(instance.box)) list.add(instance, i, shaded_batch(instance));
  }
  state_->draw(device, pass, list, use);
}

void GpuScene::draw_blended(gl::Device& device, gl::Pass& pass, const UseProgram& use, const BoxTest& visible,
                            const Distance& distance) {
  const std::vector<Instance>& instances = state_->instances;
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < instances.size(); ++i) {
    if (instances[i].alpha_mode == AlphaMode::blend && visible(instances[i].box)) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return distance(instances[a].box) > distance(instances[b].box);
  });
  DrawList list;
  for (const std::uint32_t i : order) list.add(instances[i], i, shaded_batch(instances[i]));
  state_->draw(device, pass, list, use);
}

// The casters of which these faces cast shadows.
DrawList GpuScene::State::caster_geometry(std::optional<CasterFaces> faces, const BoxTest& reaches) const {
  DrawList list;
  for (std::uint32_t i = 0; i < instances.size(); ++i) {
    const Instance& instance = instances[i];
    const bool whole = instance.casts == CastMode::always ||
                       (instance.casts == CastMode::by_alpha && instance.alpha_mode == AlphaMode::mask);
    if (instance.faces != faces || !whole || !reaches(instance.box)) continue;
    list.add(instance, i, {.deformed = instance.job >= 0, .double_sided = true});
  }
  return list;
}

void GpuScene::draw_caster_geometry(gl::Device& device, gl::Pass& pass, const gl::ProgramDesc& stages,
                                    const glm::mat4& world_to_clip, const glm::vec4& light, const BoxTest& reaches) {
  const auto [both_faces, one_face] = caster_geometry_programs(stages);
  if (const DrawList list = state_->caster_geometry(CasterFaces::both, reaches); !list.commands.empty()) {
    pass.use(both_faces).set("world_to_clip", world_to_clip);
    state_->draw(device, pass, list);
  }
  for (const CasterFaces faces : {CasterFaces::front, CasterFaces::back}) {
    const DrawList list = state_->caster_geometry(faces, reaches);
    if (list.commands.empty()) continue;
    const gl::Program& program = pass.use(one_face);
    program.set("world_to_clip", world_to_clip);
    program.set("caster_light", light);
    program.set("caster_side", faces == CasterFaces::front ? 1.0f : -1.0f);
    state_->draw_unindexed(device, pass, list);
  }
}

std::array<gl::ProgramDesc, 2> GpuScene::caster_geometry_programs(const gl::ProgramDesc& stages) {
  const gl::ProgramDesc caster = caster_program({.anchored = false}, {});
  gl::ProgramDesc both_faces = stages;
  both_faces.vertex = caster.vertex;
  both_faces.defines.insert(both_faces.defines.end(), caster.defines.begin(), caster.defines.end());
  gl::ProgramDesc one_face = stages;
  one_face.vertex = "scene/caster_face.vert";
  return {both_faces, one_face};
}

std::vector<gl::ProgramDesc> GpuScene::programs() {
  std::vector<gl::ProgramDesc> programs = Deformer::programs();
  constexpr unsigned base_color = 1u << TEXTURE_BASE_COLOR;
  for (const SurfaceTraits& traits : {SurfaceTraits{},
                                      {.masked = true},
                                      {.textures = base_color, .masked = true},
                                      {.textures = base_color, .transforms = base_color, .masked = true}}) {
    for (const CasterDraw& which :
         {CasterDraw{.anchored = false}, {}, {.marks = true}, {.marks = true, .last_pose = true}, {.behind = 0.0f}})
      programs.push_back(caster_program(which, traits));
  }
  return programs;
}

}  // namespace penumbra::scene
