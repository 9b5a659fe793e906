#include "scene/gpu_size.h"

#include <algorithm>
#include <cstdint>
#include <set>
#include <utility>

#include "scene/gpu_scene_deform.h"
#include "scene/gpu_scene_vertices.h"
#include "scene/pose.h"

namespace penumbra::scene {

namespace {

constexpr std::size_t posed_vertex = sizeof(glm::vec3) + sizeof(VertexFrame);  // what a pose changes
constexpr std::size_t triangle = sizeof(glm::vec3);                            // its normal

std::size_t triangles_of(const Primitive& primitive) {
  return primitive.topology == Topology::triangles ? primitive.indices.size() / 3 : 0;
}

// With all mip levels, each half as large as the one before, rounded down.
std::size_t texture_bytes(std::size_t width, std::size_t height) {
  std::size_t texels = width * height;
  while (width > 1 || height > 1) {
    width = std::max<std::size_t>(width / 2, 1);
    height = std::max<std::size_t>(height / 2, 1);
    texels += width * height;
  }
  return 4 * texels;
}

}  // namespace

std::size_t gpu_vertex_bytes(const Scene& scene) {
  const std::vector<bool> drawn = drawn_nodes(scene);
  std::set<const Primitive*> indexed, rigid;
  std::set<std::pair<const Primitive*, bool>> undeformed;
  std::size_t bytes = 0;
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const Node& node = scene.nodes[i];
    if (!drawn[i] || node.mesh < 0) continue;
    for (const Primitive& primitive : scene.meshes[static_cast<std::size_t>(node.mesh)].primitives) {
      if (primitive.indices.empty()) continue;
      const std::size_t vertices = primitive.positions.size(), triangles = triangles_of(primitive);
      const std::size_t pose = vertices * posed_vertex + triangles * triangle;
      if (indexed.insert(&primitive).second) bytes += primitive.indices.size() * sizeof(std::uint32_t);
      if (Deformer::deforms(node, primitive)) {
        bytes += 2 * pose + vertices * sizeof(VertexSurface);
        const bool skinned = Deformer::skins(node, primitive);
        if (undeformed.insert({&primitive, skinned}).second) bytes += Deformer::source_bytes(primitive, skinned);
      } else if (rigid.insert(&primitive).second) {
        bytes += pose + vertices * sizeof(VertexSurface);
      }
    }
  }
  return bytes;
}

std::size_t gpu_texture_bytes(const Scene& scene) {
  std::set<std::pair<int, bool>> uploaded;  // image, and whether it holds colours
  std::size_t bytes = 0;
  const auto add = [&](const TextureRef& ref, bool color) {
    if (ref.texture < 0) return;
    const int image = scene.textures[static_cast<std::size_t>(ref.texture)].image;
    if (image < 0 || !uploaded.insert({image, color}).second) return;
    const Image& pixels = scene.images[static_cast<std::size_t>(image)];
    bytes += texture_bytes(static_cast<std::size_t>(pixels.width), static_cast<std::size_t>(pixels.height));
  };
  for (const Material& material : scene.materials) {
    add(material.base_color_texture, true);
    add(material.emissive_texture, true);
    add(material.metallic_roughness_texture, false);
    add(material.normal_texture, false);
    add(material.occlusion_texture, false);
  }
  return bytes;
}

}  // namespace penumbra::scene
