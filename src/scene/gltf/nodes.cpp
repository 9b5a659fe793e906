#include <algorithm>
#include <cmath>
#include <string_view>

#include "core/log.h"
#include "scene/gltf/accessor.h"
#include "scene/gltf/read.h"
#include "scene/limits.h"
#include "scene/pose.h"

namespace penumbra::scene::gltf {
namespace {

using tinygltf::Value;

glm::vec3 to_vec3(const std::vector<double>& v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

glm::quat unit_quaternion(double x, double y, double z, double w) {
  const double length = std::sqrt(x * x + y * y + z * z + w * w);
  if (!(length > 0) || !std::isfinite(length)) return {1, 0, 0, 0};
  return {static_cast<float>(w / length), static_cast<float>(x / length), static_cast<float>(y / length),
          static_cast<float>(z / length)};
}

void read_instances(Document& document, const Value& extension, Node& node) {
  const Value& attributes = extension.Get("attributes");
  std::size_t count = 0;
  const auto view_of = [&](const char* key) {
    AccessorView view = view_accessor(document, index_or(attributes, key, 0));
    if (count == 0) {
      count = view.count;
      document.budget.spend(count, sizeof(Transform));
      node.instances.resize(count);
    }
    if (view.count != count) fail("EXT_mesh_gpu_instancing: {} has {} elements, not {}", view.name, view.count, count);
    return view;
  };
  if (attributes.Has("TRANSLATION")) {
    const auto values = read_vectors<3>(view_of("TRANSLATION"));
    for (std::size_t i = 0; i < count; ++i) node.instances[i].translation = values[i];
  }
  if (attributes.Has("ROTATION")) {
    const auto values = read_vectors<4>(view_of("ROTATION"));
    for (std::size_t i = 0; i < count; ++i)
      node.instances[i].rotation = unit_quaternion(values[i].x, values[i].y, values[i].z, values[i].w);
  }
  if (attributes.Has("SCALE")) {
    const auto values = read_vectors<3>(view_of("SCALE"));
    for (std::size_t i = 0; i < count; ++i) node.instances[i].scale = values[i];
  }
}

// Column-major; projective matrices are no transforms.
glm::mat4 affine_matrix(const float* numbers) {
  glm::mat4 matrix;
  for (glm::length_t c = 0; c < 4; ++c) {
    for (glm::length_t r = 0; r < 4; ++r) matrix[c][r] = numbers[c * 4 + r];
    const float expected = c == 3 ? 1 : 0;
    if (std::abs(matrix[c][3] - expected) > 1e-3f) fail("its matrix has a last row other than 0 0 0 1");
    matrix[c][3] = expected;
  }
  return matrix;
}

Node read_node(Document& document, const tinygltf::Node& in, std::size_t number) {
  Node node{.name = in.name, .mesh = in.mesh, .skin = in.skin, .camera = in.camera};
  node.children = in.children;
  if (!in.translation.empty()) node.transform.translation = to_vec3(in.translation);
  if (!in.scale.empty()) node.transform.scale = to_vec3(in.scale);
  if (in.rotation.size() == 4)
    node.transform.rotation = unit_quaternion(in.rotation[0], in.rotation[1], in.rotation[2], in.rotation[3]);
  if (in.matrix.size() == 16) {
    const std::vector<float> numbers(in.matrix.begin(), in.matrix.end());
    node.matrix = affine_matrix(numbers.data());
  }
  node.weights.assign(in.weights.begin(), in.weights.end());
  node.casting = casting_of_extras(in.extras, fmt::format("nodes[{}]", number));
  if (const Value* instancing = find_extension(in, "EXT_mesh_gpu_instancing"); instancing && instancing->IsObject())
    read_instances(document, *instancing, node);
  return node;
}

struct MeshFacts {
  bool skinned = false;
  int last_joint = -1;
};

MeshFacts facts_of(const Mesh& mesh) {
  MeshFacts facts;
  for (const Primitive& primitive : mesh.primitives)
    for (const glm::u16vec4& joints : primitive.joints) {
      facts.skinned = true;
      for (glm::length_t c = 0; c < 4; ++c) facts.last_joint = std::max<int>(facts.last_joint, joints[c]);
    }
  return facts;
}

// A node's mesh, skin and weights must fit together. A pose needs memory for joints and weights of each node, which is
// counted here.
void check_attachments(Document& document, const Scene& scene, const std::vector<MeshFacts>& facts, Node& node) {
  if (node.mesh < 0) {
    node.skin = -1;
    node.weights.clear();
    return;
  }
  const std::size_t targets = scene.meshes[static_cast<std::size_t>(node.mesh)].default_weights.size();
  if (!node.weights.empty() && node.weights.size() != targets)
    fail("{} weights for {} morph targets", node.weights.size(), targets);
  document.budget.spend(targets, 2 * sizeof(float));
  const MeshFacts& mesh = facts[static_cast<std::size_t>(node.mesh)];
  if (!mesh.skinned) node.skin = -1;
  if (node.skin < 0) return;
  const std::size_t joints = scene.skins[static_cast<std::size_t>(node.skin)].joints.size();
  if (joints == 0) {  // left out
    node.skin = -1;
    return;
  }
  if (mesh.last_joint >= static_cast<int>(joints))
    fail("its mesh uses joint {}, but its skin has {}", mesh.last_joint, joints);
  document.budget.spend(joints, 2 * sizeof(glm::mat4));
}

// Visits the children of drawn nodes first: if a node has two parents, the fault is reported at the parent that nothing
// drawn uses.
void link_parents(Document& document, Scene& scene) {
  for (const bool of_used : {true, false})
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
      if (document.left_out.used().holds("nodes", i) != of_used) continue;
      std::erase_if(scene.nodes[i].children, [&](int child) {
        Node& node = scene.nodes[static_cast<std::size_t>(child)];
        std::string fault;
        if (static_cast<std::size_t>(child) == i)
          fault = fmt::format("nodes[{}] is its own child", i);
        else if (node.parent >= 0)
          fault = fmt::format("nodes[{}] has two parents, {} and {}", child, node.parent, i);
        else
          node.parent = static_cast<int>(i);
        if (!fault.empty()) document.left_out.add_part("", of_used, fault);
        return !fault.empty();
      });
    }
}

// Every node has at most one parent, so nodes that no root reaches form a cycle.
void check_forest(Document& document, Scene& scene) {
  const ReadLimits& limits = document.options.limits;
  std::vector<std::pair<int, std::size_t>> open;  // node and depth
  for (std::size_t i = 0; i < scene.nodes.size(); ++i)
    if (scene.nodes[i].parent < 0) open.emplace_back(static_cast<int>(i), 1);
  std::vector<bool> reached(scene.nodes.size(), false);
  while (!open.empty()) {
    const auto [node, depth] = open.back();
    open.pop_back();
    if (depth > limits.node_depth)
      fail_over_limit(fmt::format("nodes[{}] lies {} levels deep", node, depth), limits, &ReadLimits::node_depth);
    reached[static_cast<std::size_t>(node)] = true;
    for (const int child : scene.nodes[static_cast<std::size_t>(node)].children) open.emplace_back(child, depth + 1);
  }
  for (std::size_t i = 0; i < reached.size(); ++i) {
    if (reached[i]) continue;
    document.left_out.add_part(fmt::format("nodes[{}]", i), document.left_out.used().holds("nodes", i),
                               "belongs to a cycle");
    scene.nodes[i].parent = -1;  // the loop also does this for the other nodes of the cycle, which nothing drawn uses
    scene.nodes[i].children.clear();
  }
}

// The default scene, or the first one. A file without scenes is a library of parts; all of its nodes are drawn.
void read_roots(const Document& document, Scene& scene) {
  if (document.model.scenes.empty()) {
    for (std::size_t i = 0; i < scene.nodes.size(); ++i)
      if (scene.nodes[i].parent < 0) scene.roots.push_back(static_cast<int>(i));
    return;
  }
  const auto number = static_cast<std::size_t>(std::max(document.model.defaultScene, 0));
  const tinygltf::Scene& in = document.model.scenes[number];
  scene.name = in.name;
  scene.roots = in.nodes;
  std::vector<int> sorted = in.nodes;
  std::sort(sorted.begin(), sorted.end());
  if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) fail("scenes[{}] lists a node twice", number);
  for (const int root : in.nodes)
    if (scene.nodes[static_cast<std::size_t>(root)].parent >= 0)
      fail("scenes[{}] lists nodes[{}], which has a parent", number, root);
}

}  // namespace

void read_skins(Document& document, Scene& scene) {
  for (const tinygltf::Skin& in : document.model.skins) {
    Skin skin{.name = in.name, .joints = in.joints};
    try {
      if (skin.joints.empty()) fail("has no joints");
      document.budget.spend(skin.joints.size(), sizeof(glm::mat4));
      skin.inverse_bind.assign(skin.joints.size(), glm::mat4(1));
      if (in.inverseBindMatrices >= 0) {
        AccessorView view = view_accessor(document, in.inverseBindMatrices);
        expect_components(view, 16);
        if (view.component_type != TINYGLTF_COMPONENT_TYPE_FLOAT) fail("{} must hold floats", view.name);
        if (view.count < skin.joints.size())
          fail("{} has {} matrices for {} joints", view.name, view.count, skin.joints.size());
        view.count = skin.joints.size();
        const std::vector<float> numbers = read_numbers(view);
        for (std::size_t j = 0; j < view.count; ++j) skin.inverse_bind[j] = affine_matrix(&numbers[j * 16]);
      }
    } catch (const Error& e) {
      document.left_out.add("skins", scene.skins.size(), e.what());
      skin = {};
    }
    scene.skins.push_back(std::move(skin));
  }
}

void read_nodes(Document& document, Scene& scene) {
  const std::vector<int> light_of = read_lights(document, scene);
  std::vector<MeshFacts> facts;
  for (const Mesh& mesh : scene.meshes) facts.push_back(facts_of(mesh));
  for (const tinygltf::Node& in : document.model.nodes) {
    Node node;
    try {
      node = read_node(document, in, scene.nodes.size());
      if (const Value* light = find_extension(in, "KHR_lights_punctual"); light && light->IsObject())
        node.light = light_of[static_cast<std::size_t>(index_or(*light, "light", 0))];
      check_attachments(document, scene, facts, node);
    } catch (const Error& e) {
      document.left_out.add("nodes", scene.nodes.size(), e.what());
      node = {};
    }
    scene.nodes.push_back(std::move(node));
  }
  link_parents(document, scene);
  check_forest(document, scene);
  read_roots(document, scene);
}

}  // namespace penumbra::scene::gltf
