#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

#include "core/log.h"
#include "scene/geometry.h"
#include "scene/gltf/accessor.h"
#include "scene/gltf/compression.h"
#include "scene/gltf/read.h"

namespace penumbra::scene::gltf {
namespace {

constexpr int max_joint_sets = 8;
constexpr std::size_t gpu_change = 3 * sizeof(glm::vec3);  // of a vertex by a morph target, whatever the target has

// The vertices that a primitive uses. Files often divide one large vertex array among many primitives; each copies only
// its own.
Selection select_vertices(std::vector<uint32_t>& indices, std::size_t count) {
  if (indices.size() * 2 >= count) return {.count = count};
  std::vector<uint32_t> used = indices;
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  for (uint32_t& index : indices)
    index = static_cast<uint32_t>(std::lower_bound(used.begin(), used.end(), index) - used.begin());
  const std::size_t size = used.size();
  return {.count = size, .elements = std::move(used)};
}

class PrimitiveReader {
 public:
  // `place`: "meshes[1].primitives[0]". `skinned`: whether a drawn node gives the mesh a skin.
  PrimitiveReader(Document& document, const std::vector<MaterialUse>& materials, const tinygltf::Primitive& in,
                  std::string place, bool skinned)
      : document_(document),
        in_(in),
        use_(in.material < 0 ? MaterialUse() : materials[index(in.material)]),
        place_(std::move(place)),
        skinned_(skinned) {
    out_.material = in.material;
    if (const auto* extension = find_extension(in, "KHR_draco_mesh_compression"))
      draco_ = decode_draco(document, in, *extension);
  }

  // Nothing if the primitive has nothing to draw.
  std::optional<Primitive> read() {
    const auto positions = attribute("POSITION");
    if (!positions) return std::nullopt;
    count_ = positions->count;
    read_indices();
    if (out_.indices.empty()) return std::nullopt;
    selection_ = select_vertices(out_.indices, count_);
    document_.budget.spend_vertices(selection_.count * (1 + in_.targets.size()));
    read_vertices(*positions);
    unless_unused("JOINTS_0", skinned_, [this] { read_joints(); });
    if (out_.joints.size() != selection_.count) {  // left out
      out_.joints.clear();
      out_.weights.clear();
    }
    read_targets();
    finish_normals();
    document_.budget.spend(out_.positions.size() * out_.targets.size(), gpu_change);
    return std::move(out_);
  }

 private:
  static std::size_t index(int number) { return static_cast<std::size_t>(number); }

  std::optional<AccessorView> attribute(const std::string& semantic) const {
    if (draco_)
      if (const auto found = draco_->attributes.find(semantic); found != draco_->attributes.end()) return found->second;
    const auto found = in_.attributes.find(semantic);
    if (found == in_.attributes.end()) return std::nullopt;
    return view_accessor(document_, found->second);
  }

  void read_indices() {
    std::vector<uint32_t> indices;
    if (draco_) {
      indices = draco_->indices;
    } else if (in_.indices >= 0) {
      const AccessorView view = view_accessor(document_, in_.indices);
      document_.budget.spend(view.count, sizeof(uint32_t));
      indices = read_integers(view);
    } else {
      document_.budget.spend(count_, sizeof(uint32_t));
      indices.resize(count_);
      std::iota(indices.begin(), indices.end(), 0u);
    }
    for (const uint32_t i : indices)
      if (i >= count_) fail("index {}, but there are {} vertices", i, count_);
    const int mode = draco_ ? TINYGLTF_MODE_TRIANGLES : in_.mode;
    out_.topology = expanded_topology(mode);
    document_.budget.spend(indices.size(), 3 * sizeof(uint32_t));
    out_.indices = expanded_indices(mode, indices);
  }

  template <int N>
  std::vector<glm::vec<N, float>> read_checked(const AccessorView& view) {
    if (view.count != count_) fail("{} has {} elements for {} vertices", view.name, view.count, count_);
    document_.budget.spend(selection_.count, sizeof(glm::vec<N, float>));
    return read_vectors<N>(view, selection_);
  }

  template <int N>
  std::vector<glm::vec<N, float>> read_optional(const std::string& semantic) {
    const auto view = attribute(semantic);
    return view ? read_checked<N>(*view) : std::vector<glm::vec<N, float>>();
  }

  // A fault in data that can be recomputed does not refuse a file: faulty vectors become zero and are counted.
  template <int N>
  std::vector<glm::vec<N, float>> read_repairable(const AccessorView& view, std::size_t& wrong) {
    if (view.count != count_) fail("{} has {} elements for {} vertices", view.name, view.count, count_);
    document_.budget.spend(selection_.count, sizeof(glm::vec<N, float>));
    return read_finite_vectors<N>(view, selection_, wrong);
  }

  template <class Read>
  void unless_unused(const std::string& semantic, bool used, const Read& read) {
    try {
      read();
    } catch (const Error& e) {
      if (used) throw;
      document_.left_out.add_part(fmt::format("{}.attributes.{}", place_, semantic), used, e.what());
    }
  }

  bool textured_by(int uv_set) const {
    const Material& m = use_.material;
    return std::ranges::any_of(std::array{m.base_color_texture, m.metallic_roughness_texture, m.normal_texture,
                                          m.occlusion_texture, m.emissive_texture},
                               [&](const TextureRef& ref) { return ref.texture >= 0 && ref.uv_set == uv_set; });
  }

  void read_tangents() {
    const auto tangents = attribute("TANGENT");
    if (!tangents || use_.material.normal_texture.texture < 0) return;
    std::size_t wrong = 0;
    out_.tangents = read_repairable<4>(*tangents, wrong);
    if (wrong == 0) return;
    warn("{}: {} of {} tangents are not finite; all are computed from the texture coordinates", place_, wrong,
         selection_.count);
    out_.tangents.clear();
  }

  void read_vertices(const AccessorView& positions) {
    out_.positions = read_checked<3>(positions);
    if (const auto normals = attribute("NORMAL")) {
      std::size_t wrong = 0;  // unused here: the zeros are counted when normals are repaired
      out_.normals = read_repairable<3>(*normals, wrong);
    }
    read_tangents();
    for (int slot = 0; slot < 2; ++slot) {
      const std::string semantic = fmt::format("TEXCOORD_{}", use_.uv_sets[index(slot)]);
      unless_unused(semantic, textured_by(slot), [&] { out_.uvs[index(slot)] = read_optional<2>(semantic); });
    }
    const auto colors = attribute("COLOR_0");
    if (!colors) return;
    if (colors->components == 3) {
      for (const glm::vec3& color : read_checked<3>(*colors)) out_.colors.emplace_back(color, 1);
    } else {
      out_.colors = read_checked<4>(*colors);
    }
    for (glm::vec4& color : out_.colors) color = glm::clamp(color, glm::vec4(0), glm::vec4(1e6f));
  }

  struct Influence {
    float weight;
    uint32_t joint;
  };

  // Keeps the four largest weights of each vertex over all sets.
  void read_joints() {
    std::vector<AccessorView> joints, weights;
    for (int set = 0; set < max_joint_sets; ++set) {
      const auto j = attribute(fmt::format("JOINTS_{}", set)), w = attribute(fmt::format("WEIGHTS_{}", set));
      if (!j || !w) break;
      for (const AccessorView* view : {&*j, &*w}) {
        expect_components(*view, 4);
        if (view->count != count_) fail("{} has {} elements for {} vertices", view->name, view->count, count_);
      }
      joints.push_back(*j);
      weights.push_back(*w);
    }
    if (joints.empty()) return;
    document_.budget.spend(selection_.count, sizeof(glm::u16vec4) + sizeof(glm::vec4));
    std::vector<Influence> influences;
    for (std::size_t i = 0; i < selection_.count; ++i) {
      influences.clear();
      for (std::size_t set = 0; set < joints.size(); ++set)
        add_influences(joints[set], weights[set], selection_[i], influences);
      push_heaviest(influences);
    }
  }

  static void add_influences(const AccessorView& joints, const AccessorView& weights, std::size_t vertex,
                             std::vector<Influence>& influences) {
    const std::byte* joint = joints.element(vertex);
    const std::byte* weight = weights.element(vertex);
    if (weight == nullptr) return;
    for (int c = 0; c < 4; ++c) {
      const float value = weights.number(weight, c);
      if (!std::isfinite(value)) fail_not_finite(weights, vertex);
      const uint32_t number = joint == nullptr ? 0 : joints.integer(joint, c);
      if (number > 65535) fail("{}: joint {} is over the limit of 65535", joints.name, number);
      if (value > 0) influences.push_back({value, number});
    }
  }

  void push_heaviest(std::vector<Influence>& influences) {
    const std::size_t kept = std::min<std::size_t>(influences.size(), 4);
    std::partial_sort(influences.begin(), influences.begin() + static_cast<std::ptrdiff_t>(kept), influences.end(),
                      [](const Influence& a, const Influence& b) { return a.weight > b.weight; });
    glm::u16vec4 joints(0);
    glm::vec4 weights(0);
    double sum = 0;
    for (std::size_t k = 0; k < kept; ++k) sum += influences[k].weight;
    for (std::size_t k = 0; k < kept; ++k) {
      const auto c = static_cast<glm::length_t>(k);
      joints[c] = static_cast<uint16_t>(influences[k].joint);
      weights[c] = static_cast<float>(influences[k].weight / sum);
    }
    if (kept == 0) weights[0] = 1;  // no influence: the vertex follows the first joint
    out_.joints.push_back(joints);
    out_.weights.push_back(weights);
  }

  void read_targets() {
    for (const auto& in : in_.targets) {
      MorphTarget& target = out_.targets.emplace_back();
      std::size_t wrong = 0;
      const auto read = [&](const char* semantic, bool repairable) {
        const auto found = in.find(semantic);
        if (found == in.end()) return std::vector<glm::vec3>();
        const AccessorView view = view_accessor(document_, found->second);
        return repairable ? read_repairable<3>(view, wrong) : read_checked<3>(view);
      };
      target.positions = read("POSITION", false);
      if (!out_.normals.empty()) target.normals = read("NORMAL", true);
      if (!out_.tangents.empty()) target.tangents = read("TANGENT", true);
      if (wrong > 0)
        warn("{}.targets[{}]: {} changes of normals and tangents are not finite; set to 0", place_,
             out_.targets.size() - 1, wrong);
    }
  }

  void finish_normals() {
    const bool flat = out_.normals.empty();
    if (flat && out_.topology == Topology::triangles) {
      document_.budget.spend_vertices(out_.indices.size() * (1 + in_.targets.size()));
      document_.budget.spend(out_.indices.size(), 128 + in_.targets.size() * sizeof(glm::vec3) * 2);
    }
    if (flat) make_flat_normals(out_);
    if (const std::size_t repaired = repair_normals(out_); repaired > 0)
      warn("{}: {} of {} normals are not finite or have no length; computed from the triangles", place_, repaired,
           out_.normals.size());
    const TextureRef& normal_map = use_.material.normal_texture;
    if (normal_map.texture < 0) return;
    if (out_.tangents.empty()) {
      document_.budget.spend(out_.positions.size(), sizeof(glm::vec4));
      make_tangents(out_, normal_map.uv_set, normal_map.uv_transform);
    }
    repair_tangents(out_);
  }

  Document& document_;
  const tinygltf::Primitive& in_;
  const MaterialUse use_;
  const std::string place_;
  const bool skinned_;
  std::optional<DracoMesh> draco_;
  std::size_t count_ = 0;  // vertices in the file, of which `selection_` are read
  Selection selection_;
  Primitive out_;
};

Mesh read_mesh(Document& document, const std::vector<MaterialUse>& materials, std::size_t number) {
  const tinygltf::Mesh& in = document.model.meshes[number];
  const bool skinned = document.left_out.used().skinned(number);
  Mesh mesh{.name = in.name};
  const std::size_t targets = in.primitives.empty() ? 0 : in.primitives[0].targets.size();
  for (std::size_t i = 0; i < in.primitives.size(); ++i) {
    try {
      if (in.primitives[i].targets.size() != targets)
        fail("{} morph targets, another primitive has {}", in.primitives[i].targets.size(), targets);
      const std::string place = fmt::format("meshes[{}].primitives[{}]", number, i);
      if (auto primitive = PrimitiveReader(document, materials, in.primitives[i], place, skinned).read())
        mesh.primitives.push_back(std::move(*primitive));
    } catch (const Error& e) {
      fail("primitives[{}]: {}", i, e.what());
    }
  }
  mesh.default_weights.assign(in.weights.begin(), in.weights.end());
  if (mesh.default_weights.empty()) mesh.default_weights.resize(targets, 0.0f);
  if (mesh.default_weights.size() != targets)
    fail("{} weights for {} morph targets", mesh.default_weights.size(), targets);
  return mesh;
}

}  // namespace

void read_meshes(Document& document, const std::vector<MaterialUse>& materials, Scene& scene) {
  const std::size_t count = document.model.meshes.size();
  for (std::size_t i = 0; i < count; ++i) {
    document.report({.part = "mesh", .done = i, .count = count});
    Mesh mesh;
    try {
      mesh = read_mesh(document, materials, i);
    } catch (const Error& e) {
      document.left_out.add("meshes", i, e.what());
    }
    scene.meshes.push_back(std::move(mesh));
  }
}

}  // namespace penumbra::scene::gltf
