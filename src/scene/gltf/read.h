#pragma once

#include <array>
#include <vector>

#include "scene/gltf/document.h"
#include "scene/scene.h"

namespace penumbra::scene::gltf {

// A material and which of the file's UV sets its two slots stand for.
struct MaterialUse {
  Material material;
  std::array<int, 2> uv_sets{0, 1};
};

// Each fills its part of the scene; in this order, since later parts refer to earlier ones.
std::vector<MaterialUse> read_materials(const Document& document);
// Textures, and the images that materials use; texture references without an image are cut.
void read_textures(Document& document, const ImageDecoder& decode, std::vector<MaterialUse>& materials, Scene& scene);
void read_meshes(Document& document, const std::vector<MaterialUse>& materials, Scene& scene);
void read_cameras(Document& document, Scene& scene);
void read_skins(Document& document, Scene& scene);
// The scene's number of each of the file's lights; -1 for one of an unknown kind.
std::vector<int> read_lights(Document& document, Scene& scene);
// With lights, instances and the scene's roots; checks that meshes, skins and weights fit and that the graph is a
// forest.
void read_nodes(Document& document, Scene& scene);
void read_animations(Document& document, Scene& scene);

}  // namespace penumbra::scene::gltf
