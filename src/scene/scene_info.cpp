#include "scene/scene_info.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "scene/animation.h"
#include "scene/gltf.h"
#include "scene/gpu_size.h"

namespace penumbra::scene {
namespace {

MaterialInfo describe_material(const Scene& scene, const Material& material) {
  MaterialInfo info{.name = material.name,
                    .alpha_mode = material.alpha_mode,
                    .double_sided = material.double_sided,
                    .unlit = material.unlit};
  const auto add = [&](const char* use, const TextureRef& ref) {
    if (ref.texture < 0) return;
    const Texture& texture = scene.textures[static_cast<std::size_t>(ref.texture)];
    const Image& image = scene.images[static_cast<std::size_t>(texture.image)];
    info.textures.push_back(fmt::format("{} {} x {}", use, image.width, image.height));
  };
  add("base colour", material.base_color_texture);
  add("metallic-roughness", material.metallic_roughness_texture);
  add("normal", material.normal_texture);
  add("occlusion", material.occlusion_texture);
  add("emissive", material.emissive_texture);
  return info;
}

CameraInfo describe_camera(const Camera& camera, const Node& node) {
  return {camera.name.empty() ? node.name : camera.name, camera.orthographic ? "orthographic" : "perspective"};
}

LightInfo describe_light(const PunctualLight& light, const Node& node, const glm::mat4& world) {
  LightInfo info{.name = light.name.empty() ? node.name : light.name,
                 .kind = "directional",
                 .intensity = light.intensity,
                 .unit = "lx"};
  if (light.kind == LightKind::directional) return info;
  info.kind = light.kind == LightKind::point ? "point" : "spot";
  info.unit = "cd";
  info.range = light.range;
  info.radius = light.radius;
  info.place = glm::vec3(world[3]);
  if (light.kind == LightKind::spot) info.cones = glm::degrees(glm::vec2(light.inner_cone, light.outer_cone));
  return info;
}

void count_meshes(const Scene& scene, SceneInfo& info) {
  info.meshes = scene.meshes.size();
  for (const Mesh& mesh : scene.meshes)
    for (const Primitive& primitive : mesh.primitives) {
      ++info.primitives;
      info.vertices += primitive.positions.size();
      info.morph_targets += primitive.targets.size();
    }
}

void count_drawn(const Scene& scene, const Node& node, SceneInfo& info) {
  const std::size_t copies = std::max<std::size_t>(node.instances.size(), 1);
  for (const Primitive& primitive : scene.meshes[static_cast<std::size_t>(node.mesh)].primitives) {
    const std::size_t indices = primitive.indices.size() * copies;
    switch (primitive.topology) {
      case Topology::points:
        info.points += indices;
        break;
      case Topology::lines:
        info.lines += indices / 2;
        break;
      case Topology::triangles:
        info.triangles += indices / 3;
        break;
    }
  }
}

}  // namespace

SceneInfo describe(const Scene& scene) {
  SceneInfo info{.name = scene.name, .nodes = scene.nodes.size(), .skins = scene.skins.size()};
  const Pose pose = pose_at(scene, 0);
  info.bounds = bounds_of(scene, pose);
  count_meshes(scene, info);
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const Node& node = scene.nodes[i];
    if (!pose.drawn[i]) continue;
    ++info.drawn_nodes;
    info.instances += node.instances.size();
    if (node.mesh >= 0) count_drawn(scene, node, info);
    if (node.camera >= 0)
      info.cameras.push_back(describe_camera(scene.cameras[static_cast<std::size_t>(node.camera)], node));
    if (node.light >= 0)
      info.lights.push_back(describe_light(scene.lights[static_cast<std::size_t>(node.light)], node, pose.world[i]));
  }
  for (const Skin& skin : scene.skins) info.joints += skin.joints.size();
  info.textures = scene.textures.size();
  info.images = scene.images.size();
  for (const Image& image : scene.images) info.image_bytes += image.rgba.size();
  for (const Material& material : scene.materials) info.materials.push_back(describe_material(scene, material));
  const std::vector<std::size_t> played = played_animations(scene);
  for (std::size_t i = 0; i < scene.animations.size(); ++i) {
    const Animation& animation = scene.animations[i];
    info.animations.push_back({animation.name, animation.duration, animation.channels.size(),
                               std::find(played.begin(), played.end(), i) != played.end()});
  }
  info.extensions = scene.extensions_used;
  std::ranges::copy_if(info.extensions, std::back_inserter(info.unsupported_extensions),
                       [](const std::string& name) { return !reads_extension(name); });
  info.gpu_vertex_bytes = gpu_vertex_bytes(scene);
  info.gpu_texture_bytes = gpu_texture_bytes(scene);
  return info;
}

std::optional<Bounds> animated_bounds(const Scene& scene) {
  double duration = 0;
  for (const std::size_t i : played_animations(scene))
    duration = std::max(duration, static_cast<double>(scene.animations[i].duration));
  if (duration <= 0) return std::nullopt;
  // Fewer moments of a scene with many vertices.
  constexpr std::size_t most = 120, fewest = 8, most_vertices = 50'000'000;
  std::size_t vertices = 1;
  for (const Mesh& mesh : scene.meshes) {
    for (const Primitive& primitive : mesh.primitives) vertices += primitive.positions.size();
  }
  const std::size_t steps = std::clamp(most_vertices / vertices, fewest, most);
  Bounds bounds;
  for (std::size_t i = 0; i <= steps; ++i) {
    const double time = duration * static_cast<double>(i) / static_cast<double>(steps);
    bounds.add(bounds_of(scene, pose_at(scene, time)));
  }
  return bounds;
}

}  // namespace penumbra::scene
