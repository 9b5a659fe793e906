#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "core/error.h"
#include "scene/pose.h"
#include "scene/scene.h"

namespace penumbra::test {

// What scene.h promises of every scene that a reader returns, checked independently of the reader. Throws Error with
// the first broken promise.
class SceneFaults {
 public:
  explicit SceneFaults(const scene::Scene& scene) : scene_(scene) {}

  void check() const {
    for (const scene::Image& image : scene_.images)
      require(
          image.width > 0 && image.height > 0 &&
              image.rgba.size() == static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * 4,
          "an image's pixels don't fit its size");
    for (const scene::Texture& texture : scene_.textures) optional_index(texture.image, scene_.images, "texture.image");
    for (const scene::Material& material : scene_.materials) check_material(material);
    for (const scene::Mesh& mesh : scene_.meshes)
      for (const scene::Primitive& primitive : mesh.primitives) check_primitive(mesh, primitive);
    check_nodes();
    check_animations();
  }

  // Throws unless all values that a frame uses are finite.
  void check_pose(const scene::Pose& pose) const {
    for (const glm::mat4& matrix : pose.world) require_finite(matrix);
    for (const auto& joints : pose.skin)
      for (const glm::mat4& matrix : joints) require_finite(matrix);
    for (const auto& weights : pose.weights)
      for (const float weight : weights) require(std::isfinite(weight), "a morph weight is not finite");
    const scene::Bounds bounds = scene::bounds_of(scene_, pose);
    require(std::isfinite(bounds.radius()), "the bounds are not finite");
  }

 private:
  static void require(bool ok, const char* what) {
    if (!ok) fail("broken promise: {}", what);
  }

  template <class T>
  static void optional_index(int index, const std::vector<T>& into, const char* what) {
    require(index >= -1 && index < static_cast<int>(into.size()), what);
  }

  template <class T>
  static void index(int number, const std::vector<T>& into, const char* what) {
    require(number >= 0 && number < static_cast<int>(into.size()), what);
  }

  template <class T>
  static void per_vertex(const std::vector<T>& values, std::size_t vertices, const char* what) {
    require(values.empty() || values.size() == vertices, what);
    for (const T& value : values)
      for (glm::length_t c = 0; c < T::length(); ++c) require(std::isfinite(static_cast<float>(value[c])), what);
  }

  static void require_finite(const glm::mat4& matrix) {
    for (glm::length_t c = 0; c < 4; ++c)
      for (glm::length_t r = 0; r < 4; ++r) require(std::isfinite(matrix[c][r]), "a matrix is not finite");
  }

  void check_texture(const scene::TextureRef& ref) const {
    optional_index(ref.texture, scene_.textures, "a material's texture");
    if (ref.texture >= 0)
      index(scene_.textures[static_cast<std::size_t>(ref.texture)].image, scene_.images, "a used texture's image");
    require(ref.uv_set == 0 || ref.uv_set == 1, "uv_set");
  }

  void check_material(const scene::Material& m) const {
    for (const auto* ref : {&m.base_color_texture, &m.metallic_roughness_texture, &m.normal_texture,
                            &m.occlusion_texture, &m.emissive_texture})
      check_texture(*ref);
    require(std::isfinite(m.emissive.x + m.emissive.y + m.emissive.z), "emissive is not finite");
  }

  void check_primitive(const scene::Mesh& mesh, const scene::Primitive& p) const {
    const std::size_t count = p.positions.size();
    require(count > 0 && p.normals.size() == count, "positions and normals are never empty");
    const std::size_t corners = p.topology == scene::Topology::triangles ? 3
                                : p.topology == scene::Topology::lines   ? 2
                                                                         : 1;
    require(p.indices.size() % corners == 0, "indices are not whole primitives");
    for (const uint32_t i : p.indices) require(i < count, "an index is beyond the vertices");
    per_vertex(p.positions, count, "positions");
    per_vertex(p.normals, count, "normals");
    per_vertex(p.tangents, count, "tangents");
    for (const auto& uvs : p.uvs) per_vertex(uvs, count, "uvs");
    per_vertex(p.colors, count, "colors");
    per_vertex(p.joints, count, "joints");
    per_vertex(p.weights, count, "weights");
    require(p.joints.size() == p.weights.size(), "joints without weights");
    for (const glm::vec3& n : p.normals) require(std::abs(glm::length(n) - 1) < 1e-3f, "a normal's length");
    for (const glm::vec4& t : p.tangents)
      require(std::abs(glm::length(glm::vec3(t)) - 1) < 1e-3f, "a tangent's length");
    for (const glm::vec4& w : p.weights) require(std::abs(w.x + w.y + w.z + w.w - 1) < 1e-3f, "weights sum to 1");
    require(p.targets.size() == mesh.default_weights.size(), "one default weight a morph target");
    for (const scene::MorphTarget& target : p.targets) {
      per_vertex(target.positions, count, "target positions");
      per_vertex(target.normals, count, "target normals");
      per_vertex(target.tangents, count, "target tangents");
    }
    optional_index(p.material, scene_.materials, "a primitive's material");
  }

  void check_nodes() const {
    for (std::size_t i = 0; i < scene_.nodes.size(); ++i) {
      const scene::Node& node = scene_.nodes[i];
      optional_index(node.parent, scene_.nodes, "node.parent");
      optional_index(node.mesh, scene_.meshes, "node.mesh");
      optional_index(node.skin, scene_.skins, "node.skin");
      optional_index(node.camera, scene_.cameras, "node.camera");
      optional_index(node.light, scene_.lights, "node.light");
      for (const int child : node.children) {
        index(child, scene_.nodes, "node.children");
        require(scene_.nodes[static_cast<std::size_t>(child)].parent == static_cast<int>(i), "a child's parent");
      }
      std::size_t steps = 0;
      for (int up = node.parent; up >= 0; up = scene_.nodes[static_cast<std::size_t>(up)].parent)
        require(++steps <= scene_.nodes.size(), "a cycle of nodes");
      if (node.skin >= 0) check_skinned(node);
    }
    for (const int root : scene_.roots) index(root, scene_.nodes, "a root");
  }

  void check_skinned(const scene::Node& node) const {
    const scene::Skin& skin = scene_.skins[static_cast<std::size_t>(node.skin)];
    require(!skin.joints.empty() && skin.joints.size() == skin.inverse_bind.size(), "a skin's joints");
    for (const int joint : skin.joints) index(joint, scene_.nodes, "a joint");
    require(node.mesh >= 0, "a skin without a mesh");
    for (const scene::Primitive& p : scene_.meshes[static_cast<std::size_t>(node.mesh)].primitives)
      for (const glm::u16vec4& joints : p.joints)
        for (glm::length_t c = 0; c < 4; ++c) require(joints[c] < skin.joints.size(), "a vertex's joint");
  }

  void check_animations() const {
    for (const scene::Animation& animation : scene_.animations)
      for (const scene::AnimationChannel& channel : animation.channels) {
        index(channel.node, scene_.nodes, "a channel's node");
        const bool cubic = channel.interpolation == scene::Interpolation::cubic_spline;
        require(channel.components > 0 && !channel.times.empty() &&
                    channel.values.size() ==
                        channel.times.size() * static_cast<std::size_t>(channel.components) * (cubic ? 3 : 1),
                "a channel's values don't fit its keys");
        for (std::size_t k = 1; k < channel.times.size(); ++k)
          require(channel.times[k] >= channel.times[k - 1], "key times fall");
        for (const float value : channel.values) require(std::isfinite(value), "a key's value is not finite");
      }
  }

  const scene::Scene& scene_;
};

inline void check_scene(const scene::Scene& scene) {
  const SceneFaults faults(scene);
  faults.check();
  faults.check_pose(scene::rest_pose(scene));
  for (const double seconds : {0.0, 0.37, 1e6}) faults.check_pose(scene::pose_at(scene, seconds));
}

}  // namespace penumbra::test
