#include "scene/gltf/used.h"

#include <utility>

namespace penumbra::scene::gltf {

using Json = nlohmann::json;

const std::map<std::string, Json, std::less<>>& stand_ins() {
  static const std::map<std::string, Json, std::less<>> all = {
      {"accessors", {{"componentType", 5126}, {"count", 1}, {"type", "SCALAR"}}},
      {"animations", {{"channels", Json::array()}, {"samplers", Json::array()}}},
      {"buffers", {{"byteLength", 1}}},
      {"bufferViews", {{"buffer", 0}, {"byteLength", 1}}},
      {"cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1.0}, {"znear", 0.1}}}}},
      {"images", Json::object()},
      {"materials", Json::object()},
      {"meshes", {{"primitives", Json::array()}}},
      {"nodes", Json::object()},
      {"samplers", Json::object()},
      {"scenes", Json::object()},
      {"skins", {{"joints", Json::array()}}},
      {"textures", Json::object()},
      {lights_array, {{"type", "directional"}}},
  };
  return all;
}

namespace {

// Null if a member is missing or its owner is not an object.
const Json* member(const Json* value, std::string_view key) {
  if (value == nullptr || !value->is_object()) return nullptr;
  const auto found = value->find(key);
  return found == value->end() ? nullptr : &*found;
}

const Json* extension(const Json* value, std::string_view name) { return member(member(value, "extensions"), name); }

}  // namespace

const Json* array_at(const Json& document, std::string_view path) {
  const Json* value = &document;
  while (value != nullptr && !path.empty()) {
    const auto dot = path.find('.');
    value = member(value, path.substr(0, dot));
    path = dot == std::string_view::npos ? std::string_view() : path.substr(dot + 1);
  }
  return value != nullptr && value->is_array() ? value : nullptr;
}

// Follows references from the drawn nodes, without recursion, because chains can be long.
class UsedFinder {
 public:
  UsedFinder(const Json& document, Used& used) : document_(document), used_(used) {
    for (const auto& [array, stand_in] : stand_ins()) {
      const Json* elements = array_at(document, array);
      used.marks_[array].resize(elements == nullptr ? 0 : elements->size());
    }
    used.skinned_.resize(used.marks_["meshes"].size());
    find_parents();
    mark_roots();
    follow();
    each(&document, "animations", [this](const Json& animation) { mark_animation(animation); });
    follow();
  }

 private:
  // Calls `action` for each element of the array that is a member of `owner`.
  template <class Action>
  static void each(const Json* owner, std::string_view key, const Action& action) {
    const Json* elements = member(owner, key);
    if (elements == nullptr || !elements->is_array()) return;
    for (const Json& element : *elements) action(element);
  }

  // The index of the element that a number refers to.
  std::size_t index_in(std::string_view array, const Json* number) const {
    const std::size_t size = used_.marks_.find(array)->second.size();
    if (number == nullptr || !number->is_number()) return size;
    const double value = number->get<double>();
    return value >= 0 && value < static_cast<double>(size) ? static_cast<std::size_t>(value) : size;
  }

  void mark(const std::string& array, const Json* number) {
    std::vector<bool>& marks = used_.marks_[array];
    const std::size_t index = index_in(array, number);
    if (index >= marks.size() || marks[index]) return;
    marks[index] = true;
    open_.emplace_back(array, index);
  }

  void mark(const std::string& array, std::size_t index) {
    const Json number = index;
    mark(array, &number);
  }

  void find_parents() {
    parents_.assign(used_.marks_["nodes"].size(), parents_.max_size());
    std::size_t i = 0;
    each(&document_, "nodes", [&](const Json& node) {
      each(&node, "children", [&](const Json& child) {
        if (const std::size_t c = index_in("nodes", &child); c < parents_.size()) parents_[c] = i;
      });
      ++i;
    });
  }

  void mark_roots() {
    const Json* scenes = array_at(document_, "scenes");
    if (scenes == nullptr || scenes->empty()) {  // without scenes, all nodes are drawn
      for (std::size_t i = 0; i < parents_.size(); ++i) mark("nodes", i);
      return;
    }
    const Json* number = member(&document_, "scene");
    const Json first = 0;
    mark("scenes", number == nullptr ? &first : number);
  }

  void follow() {
    while (!open_.empty()) {
      const auto [array, index] = std::move(open_.back());
      open_.pop_back();
      visit(array, (*array_at(document_, array))[index]);
    }
  }

  void visit(const std::string& array, const Json& element) {
    if (array == "scenes") each(&element, "nodes", [this](const Json& node) { mark("nodes", &node); });
    if (array == "nodes") visit_node(element);
    if (array == "meshes") each(&element, "primitives", [this](const Json& primitive) { visit_primitive(primitive); });
    if (array == "materials") visit_material(element);
    if (array == "textures") {
      mark("images", member(&element, "source"));
      mark("samplers", member(&element, "sampler"));
    }
    if (array == "images" || array == "accessors") mark("bufferViews", member(&element, "bufferView"));
    if (array == "accessors")
      for (const char* part : {"indices", "values"})
        mark("bufferViews", member(member(member(&element, "sparse"), part), "bufferView"));
    if (array == "bufferViews") {
      const Json* compressed = extension(&element, "EXT_meshopt_compression");
      mark("buffers", member(compressed != nullptr ? compressed : &element, "buffer"));
    }
    if (array == "skins") {
      mark("accessors", member(&element, "inverseBindMatrices"));
      each(&element, "joints", [this](const Json& joint) { mark_with_ancestors(joint); });
    }
  }

  // A joint's transform depends on its ancestors, whether they are drawn or not.
  void mark_with_ancestors(const Json& joint) {
    for (std::size_t i = index_in("nodes", &joint); i < parents_.size(); i = parents_[i]) {
      if (used_.marks_["nodes"][i]) return;
      mark("nodes", i);
    }
  }

  void visit_node(const Json& node) {
    each(&node, "children", [this](const Json& child) { mark("nodes", &child); });
    mark("cameras", member(&node, "camera"));
    mark(lights_array, member(extension(&node, "KHR_lights_punctual"), "light"));
    const Json* mesh = member(&node, "mesh");
    if (mesh == nullptr) return;
    mark("meshes", mesh);
    mark_members("accessors", member(extension(&node, "EXT_mesh_gpu_instancing"), "attributes"));
    visit_skin(node, index_in("meshes", mesh));
  }

  void visit_skin(const Json& node, std::size_t mesh) {
    const Json* skin = member(&node, "skin");
    if (skin == nullptr || mesh >= used_.skinned_.size()) return;
    bool has_joints = false;
    each(&(*array_at(document_, "meshes"))[mesh], "primitives", [&](const Json& primitive) {
      has_joints = has_joints || member(member(&primitive, "attributes"), "JOINTS_0") != nullptr;
    });
    if (!has_joints) return;
    used_.skinned_[mesh] = true;
    mark("skins", skin);
  }

  void mark_members(const std::string& array, const Json* object) {
    if (object == nullptr || !object->is_object()) return;
    for (const auto& [key, value] : object->items())
      if (!key.starts_with('_')) mark(array, &value);  // an application-specific attribute is not read
  }

  void visit_primitive(const Json& primitive) {
    mark_members("accessors", member(&primitive, "attributes"));
    mark("accessors", member(&primitive, "indices"));
    mark("materials", member(&primitive, "material"));
    each(&primitive, "targets", [this](const Json& target) { mark_members("accessors", &target); });
    mark("bufferViews", member(extension(&primitive, "KHR_draco_mesh_compression"), "bufferView"));
  }

  void visit_material(const Json& material) {
    const auto texture = [this](const Json* owner, const char* key) {
      mark("textures", member(member(owner, key), "index"));
    };
    const Json* pbr = member(&material, "pbrMetallicRoughness");
    texture(pbr, "baseColorTexture");
    texture(pbr, "metallicRoughnessTexture");
    for (const char* key : {"normalTexture", "occlusionTexture", "emissiveTexture"}) texture(&material, key);
    texture(extension(&material, "KHR_materials_pbrSpecularGlossiness"), "diffuseTexture");
  }

  // An animation is used if it moves a used node.
  void mark_animation(const Json& animation) {
    const Json* samplers = member(&animation, "samplers");
    bool used = false;
    each(&animation, "channels", [&](const Json& channel) {
      const std::size_t node = index_in("nodes", member(member(&channel, "target"), "node"));
      if (node >= parents_.size() || !used_.marks_["nodes"][node]) return;
      used = true;
      const Json* number = member(&channel, "sampler");
      if (samplers == nullptr || !samplers->is_array() || number == nullptr || !number->is_number()) return;
      const double sampler = number->get<double>();
      if (!(sampler >= 0 && sampler < static_cast<double>(samplers->size()))) return;
      const Json& keys = (*samplers)[static_cast<std::size_t>(sampler)];
      mark("accessors", member(&keys, "input"));
      mark("accessors", member(&keys, "output"));
    });
    if (used) mark("animations", animation_);
    ++animation_;
  }

  const Json& document_;
  Used& used_;
  std::vector<std::size_t> parents_;  // of nodes; beyond them for a root
  std::vector<std::pair<std::string, std::size_t>> open_;
  std::size_t animation_ = 0;
};

Used::Used(const Json& document) { UsedFinder(document, *this); }

bool Used::holds(std::string_view array, std::size_t index) const {
  const auto found = marks_.find(array);
  return found != marks_.end() && index < found->second.size() && found->second[index];
}

bool Used::skinned(std::size_t mesh) const { return mesh < skinned_.size() && skinned_[mesh]; }

}  // namespace penumbra::scene::gltf
