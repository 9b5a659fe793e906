#pragma once

#include <array>
#include <vector>

#include "scene/gltf/document.h"
#include "scene/scene.h"

namespace penumbra::scene::gltf {

// A material, and which two of the file's UV sets its UV slots 0 and 1 refer to.
struct MaterialUse {
  Material material;
  std::array<int, 2> uv_sets{0, 1};
};

// Each function reads one part of the scene. They are called in this order, since later parts refer to earlier ones.
std::vector<MaterialUse> read_materials(const Document& document);
// Reads textures, and the images that materials use; references to a texture without an image are removed.
void read_textures(Document& document, const ImageDecoder& decode, std::vector<MaterialUse>& materials, Scene& scene);
void read_meshes(Document& document, const std::vector<MaterialUse>& materials, Scene& scene);
void read_cameras(Document& document, Scene& scene);
void read_skins(Document& document, Scene& scene);
// The scene's index of each of the file's lights; -1 for one of an unknown kind.
std::vector<int> read_lights(Document& document, Scene& scene);
// Reads nodes with their lights and instances, and the scene's roots. Checks that meshes, skins and weights fit
// together and that the graph is a forest.
void read_nodes(Document& document, Scene& scene);
void read_animations(Document& document, Scene& scene);

}  // namespace penumbra::scene::gltf
