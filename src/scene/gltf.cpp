#include "scene/gltf.h"

#include <exception>
#include <new>
#include <string>

#include "core/error.h"
#include "scene/drawn.h"
#include "scene/gltf/read.h"
#include "scene/limits.h"
#include "scene/one_line.h"
#include "scene/pose.h"
#include "scene/reach.h"
#include "scene/sky.h"

namespace penumbra::scene {
namespace {

void check_drawn(const Scene& scene, const ReadLimits& limits) {
  const auto [instances, triangles, deformed] = count_drawn(scene);
  if (instances > limits.instances)
    fail_over_limit(fmt::format("{} primitives to draw", instances), limits, &ReadLimits::instances);
  if (triangles > limits.triangles)
    fail_over_limit(fmt::format("{} triangles to draw", triangles), limits, &ReadLimits::triangles);
  if (deformed > limits.vertices)
    fail_over_limit(fmt::format("{} vertices of skinned and morphed meshes", deformed), limits, &ReadLimits::vertices);
}

// Float arithmetic in the passes would overflow on coordinates further out.
void check_extent(const Scene& scene, double limit) {
  const double reach = reach_of(scene, rest_pose(scene));
  if (!(reach <= limit)) fail("{}", over_extent(reach, limit));
}

void mark_skies(Scene& scene) {
  for (const int node : find_skies(scene, rest_pose(scene))) scene.nodes[static_cast<std::size_t>(node)].sky = true;
}

Scene read_scene(const std::filesystem::path& path, const ImageDecoder& decode, const ReadOptions& options) {
  gltf::Document document = gltf::read_document(path, options);
  Scene scene;
  scene.files = document.files;
  scene.files.push_back(path);
  scene.extensions_used = document.model.extensionsUsed;
  std::vector<gltf::MaterialUse> materials = gltf::read_materials(document);
  gltf::read_textures(document, decode, materials, scene);
  gltf::read_meshes(document, materials, scene);
  gltf::read_cameras(document, scene);
  gltf::read_skins(document, scene);
  gltf::read_nodes(document, scene);
  gltf::read_animations(document, scene);
  document.left_out.finish();
  check_drawn(scene, options.limits);
  check_extent(scene, options.limits.extent);
  mark_skies(scene);
  if (scene.name.empty()) scene.name = path.stem().string();
  return scene;
}

}  // namespace

Scene read_gltf(const std::filesystem::path& path, const ImageDecoder& decode, const ReadOptions& options) {
  const std::string name = path.empty() ? "''" : path.string();
  try {
    return read_scene(path, decode, options);
  } catch (const Error& e) {
    fail("{}: {}", name, one_line(e.what()));
  } catch (const std::bad_alloc&) {
    fail("{}: not enough memory to read it", name);
  } catch (const std::exception& e) {  // thrown by a library
    fail("{}: {}", name, one_line(e.what()));
  }
}

}  // namespace penumbra::scene
