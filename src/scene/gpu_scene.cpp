#include "scene/gpu_scene.h"

#include <algorithm>
#include <atomic>
#include <map>
#include <numeric>
#include <ranges>
#include <set>
#include <tuple>

#include "scene/gpu_scene_boxes.h"
#include "scene/gpu_scene_state.h"

namespace penumbra::scene {

namespace {

// Offsets of a primitive's indices and undeformed vertices in the shared buffers.
struct Placed {
  std::uint32_t first_index = 0;
  std::optional<std::uint32_t> base_vertex;  // absent if only deformed instances use it
  std::uint32_t first_triangle = 0;
  Bounds bounds;
};

CastMode casts_of(const Primitive& primitive, const Material& material) {
  if (primitive.topology != Topology::triangles) return CastMode::never;
  if (material.alpha_mode == AlphaMode::opaque) return CastMode::always;
  if (material.base_color_texture.texture >= 0 || !primitive.colors.empty()) return CastMode::by_alpha;
  const float alpha = material.base_color.a;
  const bool there = material.alpha_mode == AlphaMode::mask ? alpha >= material.alpha_cutoff : alpha > 0.5f;
  return there ? CastMode::always : CastMode::never;
}

Bounds bounds_of(const Primitive& primitive) {
  Bounds bounds;
  for (const glm::vec3& position : primitive.positions) bounds.add(position);
  return bounds;
}

// Collects a scene's primitives into shared streams, and its instances.
class Builder {
 public:
  Builder(const Scene& scene, const Materials& materials, Deformer& deformer)
      : scene_(scene), materials_(materials), deformer_(deformer) {
    const Pose rest = rest_pose(scene);
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
      if (rest.drawn[i] && scene.nodes[i].mesh >= 0) add_node(static_cast<int>(i));
    }
    for (const bool blended : {false, true}) share_programs_of(blended);
    std::stable_sort(instances.begin(), instances.end(), [](const Instance& a, const Instance& b) {
      const auto key = [](const Instance& x) {
        return std::tuple(x.job >= 0, x.topology, x.alpha_mode, x.traits, x.material, x.first_index, x.base_vertex);
      };
      return key(a) < key(b);
    });
  }

  VertexStreams rigid, deformed;
  std::vector<std::uint32_t> indices;
  std::vector<glm::vec3> triangle_normals;  // of what does not deform
  std::uint32_t deformed_triangles = 0;
  std::vector<Instance> instances;
  std::map<const Primitive*, std::vector<MeshPart>> parts;  // of large ones that do not deform

 private:
  void add_node(int node) {
    const int mesh = scene_.nodes[static_cast<std::size_t>(node)].mesh;
    for (const Primitive& primitive : scene_.meshes[static_cast<std::size_t>(mesh)].primitives) {
      if (!primitive.indices.empty()) add_primitive(node, primitive);
    }
  }

  void add_primitive(int node_index, const Primitive& primitive) {
    const Node& node = scene_.nodes[static_cast<std::size_t>(node_index)];
    const Material& material = Materials::of(scene_, primitive.material);
    Placed& placed = place(primitive);
    Instance instance{.primitive = &primitive,
                      .node = node_index,
                      .topology = primitive.topology,
                      .alpha_mode = material.alpha_mode,
                      .casts = casts_of(primitive, material),
                      .material = materials_.index_of(primitive.material),
                      .traits = {.textures = materials_.textures_of(primitive.material),
                                 .transforms = materials_.transforms_of(primitive.material),
                                 .colors = !primitive.colors.empty(),
                                 .masked = material.alpha_mode == AlphaMode::mask,
                                 .triangles = primitive.topology == Topology::triangles},
                      .double_sided = material.double_sided,
                      .first_index = placed.first_index,
                      .index_count = static_cast<std::uint32_t>(primitive.indices.size()),
                      .local = placed.bounds};
    if (Deformer::deforms(node, primitive)) {
      instance.base_vertex = deformed.append(primitive);
      instance.first_triangle = deformed_triangles;
      if (instance.traits.triangles) deformed_triangles += instance.index_count / 3;
      instance.job = deformer_.add(scene_, node_index, primitive,
                                   {.first_index = instance.first_index,
                                    .first_vertex = instance.base_vertex,
                                    .first_triangle = instance.first_triangle});
    } else {
      if (!placed.base_vertex) place_rigid(primitive, placed);
      instance.base_vertex = *placed.base_vertex;
      instance.first_triangle = placed.first_triangle;
      if (const auto found = parts.find(&primitive); found != parts.end()) instance.parts = &found->second;
    }
    // Skinned vertices are already in world space, so instance transforms do not apply to them.
    const bool copied = !node.instances.empty() && !(instance.job >= 0 && deformer_.skinned(instance.job));
    for (std::size_t copy = 0; copy < (copied ? node.instances.size() : 1); ++copy) {
      instance.copy = copied ? static_cast<int>(copy) : -1;
      instances.push_back(instance);
    }
  }

  Placed& place(const Primitive& primitive) {
    auto [entry, added] = placed_.try_emplace(&primitive);
    if (added) {
      entry->second.first_index = static_cast<std::uint32_t>(indices.size());
      entry->second.bounds = bounds_of(primitive);
      indices.insert(indices.end(), primitive.indices.begin(), primitive.indices.end());
    }
    return entry->second;
  }

  // Blended surfaces have other programs than the rest.
  void share_programs_of(bool blended) {
    const auto drawn = [&](const Instance& instance) { return (instance.alpha_mode == AlphaMode::blend) == blended; };
    std::set<SurfaceTraits> all;
    for (const Instance& instance : instances | std::views::filter(drawn)) all.insert(instance.traits);
    const SharedTraits shared = share_programs(all);
    for (Instance& instance : instances | std::views::filter(drawn)) instance.traits = shared.at(instance.traits);
  }

  void place_rigid(const Primitive& primitive, Placed& placed) {
    placed.base_vertex = rigid.append(primitive);
    placed.first_triangle = static_cast<std::uint32_t>(triangle_normals.size());
    const std::vector<glm::vec3> normals = scene::triangle_normals(primitive);
    triangle_normals.insert(triangle_normals.end(), normals.begin(), normals.end());
    if (std::vector<MeshPart> divided = parts_of(primitive); !divided.empty())
      parts.emplace(&primitive, std::move(divided));
  }

  const Scene& scene_;
  const Materials& materials_;
  Deformer& deformer_;
  std::map<const Primitive*, Placed> placed_;
};

template <class T>
gl::Buffer upload(std::string_view label, const std::vector<T>& contents) {
  return gl::Buffer::of(label, std::span<const T>(contents));
}

std::uint64_t next_id() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

bool has_light(const Scene& scene) {
  const Pose rest = rest_pose(scene);
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const int light = scene.nodes[i].light;
    if (rest.drawn[i] && light >= 0) return true;
  }
  return false;
}

}  // namespace

GpuScene::State::State(gl::Device& device, const Scene& described)
    : scene(described), id(next_id()), materials(device, described) {
  Builder builder(scene, materials, deformer);
  deformer.upload();
  instances = std::move(builder.instances);
  parts = std::move(builder.parts);  // moved as a whole: the instances' pointers stay valid
  positions = upload("positions", builder.rigid.positions);
  frames = upload("normals and tangents", builder.rigid.frames);
  surfaces = upload("texture coordinates and colours", builder.rigid.surfaces);
  deformed_surfaces = upload("deformed texture coordinates and colours", builder.deformed.surfaces);
  indices = upload("indices", builder.indices);
  triangle_normals = upload("triangle normals", builder.triangle_normals);
  for (PosedVertices& vertices : posed) {
    vertices.positions = upload("deformed positions", builder.deformed.positions);
    vertices.frames = upload("deformed normals and tangents", builder.deformed.frames);
    vertices.triangle_normals = upload("deformed triangle normals", std::vector<glm::vec3>(builder.deformed_triangles));
  }
  std::vector<std::uint32_t> numbers(instances.size());
  std::iota(numbers.begin(), numbers.end(), 0u);
  instance_numbers = upload("instance numbers", numbers);
  instance_blocks = gl::Buffer("instances", std::max<std::size_t>(instances.size(), 1) * sizeof(glsl::InstanceBlock));
  for (const Instance& instance : instances) {
    const bool blends = instance.alpha_mode == AlphaMode::blend;
    blended = blended || blends;
    emissive = emissive || (!blends && Materials::of(scene, instance.primitive->material).emissive != glm::vec3(0));
  }
  lit_by_file = has_light(scene);
  choose_faces();
}

PosedVertices& GpuScene::State::posed_at(gl::Device& device, double time, const PosedVertices* keep) {
  for (PosedVertices& vertices : posed) {
    if (vertices.show(device, time)) return vertices;
  }
  PosedVertices& vertices = &posed[0] == keep ? posed[1] : posed[0];
  vertices.time.reset();  // until all below has succeeded
  vertices.pose = pose_at(scene, time);
  deformer.run(
      device, vertices.pose, indices,
      {.positions = vertices.positions, .frames = vertices.frames, .triangle_normals = vertices.triangle_normals});
  vertices.time = time;
  vertices.shader_changes = device.shaders.changes();
  return vertices;
}

void GpuScene::pose(gl::Device& device, double last_time, double time) {
  State& s = *state_;
  const auto keeps = [&](const PosedVertices& vertices) { return vertices.show(device, time); };
  const auto kept = std::find_if(s.posed.begin(), s.posed.end(), keeps);
  const PosedVertices* last = &s.posed_at(device, last_time, kept == s.posed.end() ? nullptr : &*kept);
  const PosedVertices* now = &s.posed_at(device, time, last);
  const bool same = s.now == now && s.last == last && s.times == std::pair(last_time, time);
  if (same) return;
  s.now = now;
  s.last = last;
  s.times = {last_time, time};
  s.set_vertex_arrays();
  s.update_instances();
}

void GpuScene::State::set_vertex_arrays() const {
  unindexed.set({.positions = &positions,
                 .last_positions = &positions,
                 .frames = &frames,
                 .surfaces = &surfaces,
                 .instances = &instance_numbers,
                 .instance_blocks = &instance_blocks,
                 .indices = &indices});
  rigid.set({.positions = &positions,
             .last_positions = &positions,
             .frames = &frames,
             .surfaces = &surfaces,
             .instances = &instance_numbers,
             .instance_blocks = &instance_blocks,
             .indices = &indices});
  deformed.set({.positions = &now->positions,
                .last_positions = &last->positions,
                .frames = &now->frames,
                .surfaces = &deformed_surfaces,
                .instances = &instance_numbers,
                .instance_blocks = &instance_blocks,
                .indices = &indices});
}

void GpuScene::State::update_instances() {
  const auto placement = [this](const Instance& instance, const Pose& pose) {
    if (instance.job >= 0 && deformer.skinned(instance.job)) return glm::mat4(1.0f);
    const auto node = static_cast<std::size_t>(instance.node);
    if (instance.copy < 0) return pose.world[node];
    return pose.world[node] * to_matrix(scene.nodes[node].instances[static_cast<std::size_t>(instance.copy)]);
  };
  const auto box = [this](const Instance& instance, const Pose& pose, const glm::mat4& world) {
    return transformed(instance.job >= 0 ? deformer.bounds(instance.job, pose) : instance.local, world);
  };
  std::vector<glsl::InstanceBlock> blocks;
  blocks.reserve(instances.size());
  moved = false;
  receivers = blended_receivers = {};
  for (Instance& instance : instances) {
    const glm::mat4& world = instance.world = placement(instance, now->pose);
    const glm::mat4 last_world = placement(instance, last->pose);
    const bool skinned = instance.job >= 0 && deformer.skinned(instance.job);
    instance.mirrored = skinned ? deformer.mirrored(instance.job, now->pose) : is_mirror(world);
    instance.moved = world != last_world ||
                     (instance.job >= 0 && now != last && deformer.differs(instance.job, now->pose, last->pose));
    instance.box = box(instance, now->pose, world);
    instance.last_box = instance.moved ? box(instance, last->pose, last_world) : instance.box;
    moved = moved || instance.moved;
    receivers.add(instance.box);
    if (instance.alpha_mode == AlphaMode::blend) blended_receivers.add(instance.box);
    blocks.push_back({.world = world,
                      .last_world = last_world,
                      .area = glm::mat4(area_matrix(glm::mat3(world))),
                      .first_index = instance.first_index,
                      .base_vertex = instance.base_vertex,
                      .first_triangle = instance.first_triangle,
                      .winding = instance.mirrored ? -1.0f : 1.0f});
  }
  instance_blocks.write(std::as_bytes(std::span(blocks)));
  update_caster_bounds();
}

void GpuScene::State::choose_faces() {
  for (Instance& instance : instances) {
    const Material& material = Materials::of(scene, instance.primitive->material);
    instance.faces.reset();
    if (instance.casts != CastMode::never)
      instance.faces = casting_faces(scene.nodes[static_cast<std::size_t>(instance.node)], material, choice);
  }
}

void GpuScene::State::update_caster_bounds() {
  casters = moved_casters = {};
  for (const Instance& instance : instances) {
    if (!instance.faces) continue;
    casters.add(instance.box);
    if (!instance.moved) continue;
    moved_casters.add(instance.box);
    moved_casters.add(instance.last_box);
  }
}

void GpuScene::choose_casters(const CasterChoice& choice) {
  if (state_->choice == choice) return;
  state_->choice = choice;
  state_->choose_faces();
  state_->update_caster_bounds();
}

GpuScene::GpuScene(gl::Device& device, const Scene& scene) : state_(std::make_unique<State>(device, scene)) {}
GpuScene::~GpuScene() = default;

const Scene& GpuScene::scene() const { return state_->scene; }
std::uint64_t GpuScene::id() const { return state_->id; }
bool GpuScene::has_blended() const { return state_->blended; }
bool GpuScene::has_emissive() const { return state_->emissive; }
bool GpuScene::moved() const { return state_->moved; }
Bounds GpuScene::casters() const { return state_->casters; }
Bounds GpuScene::receivers() const { return state_->receivers; }
Bounds GpuScene::blended_receivers() const { return state_->blended_receivers; }
Bounds GpuScene::moved_bounds() const { return state_->moved_casters; }
bool GpuScene::lit_by_file() const { return state_->lit_by_file; }

}  // namespace penumbra::scene
