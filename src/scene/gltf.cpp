#include "scene/gltf.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <new>
#include <string>
#include <string_view>

#include "core/error.h"
#include "scene/gltf/read.h"
#include "scene/pose.h"

namespace penumbra::scene {
namespace {

constexpr std::size_t longest_message = 400;

// Faults quote the file, which may hold anything: control characters and bytes outside ASCII become '?', so that the
// message stays one printable line.
std::string one_line(std::string_view text) {
  std::string line(text.substr(0, longest_message));
  while (!line.empty() && (line.back() == '\n' || line.back() == ' ')) line.pop_back();
  for (char& c : line)
    if (c < ' ' || c > '~') c = c == '\n' ? ' ' : '?';
  return line;
}

// Float arithmetic on what lies further out would overflow in the passes.
void check_extent(const Scene& scene, double limit) {
  const Pose pose = rest_pose(scene);
  const Bounds bounds = bounds_of(scene, pose);
  double furthest = 0;
  for (const glm::vec3& corner : {bounds.min, bounds.max})
    for (glm::length_t c = 0; c < 3; ++c)
      furthest = std::isfinite(corner[c]) ? std::max<double>(furthest, std::abs(corner[c])) : HUGE_VAL;
  for (const glm::mat4& world : pose.world)
    for (glm::length_t c = 0; c < 4; ++c)
      for (glm::length_t r = 0; r < 3; ++r) furthest = std::max<double>(furthest, std::abs(world[c][r]));
  if (!(furthest <= limit)) fail("reaches {:.3g} m from the origin, over the limit of {:.3g} m", furthest, limit);
}

Scene read_scene(const std::filesystem::path& path, const ImageDecoder& decode, const ReadLimits& limits) {
  gltf::Document document = gltf::read_document(path, limits);
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
  check_extent(scene, limits.extent);
  if (scene.name.empty()) scene.name = path.stem().string();
  return scene;
}

}  // namespace

Scene read_gltf(const std::filesystem::path& path, const ImageDecoder& decode, const ReadLimits& limits) {
  try {
    return read_scene(path, decode, limits);
  } catch (const Error& e) {
    fail("{}: {}", path.string(), one_line(e.what()));
  } catch (const std::bad_alloc&) {
    fail("{}: not enough memory to read it", path.string());
  } catch (const std::exception& e) {  // of a library below
    fail("{}: {}", path.string(), one_line(e.what()));
  }
}

}  // namespace penumbra::scene
