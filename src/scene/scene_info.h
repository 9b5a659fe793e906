#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scene/pose.h"
#include "scene/scene.h"

namespace penumbra::scene {

// What `penumbra info` prints about a scene.

struct MaterialInfo {
  std::string name;
  AlphaMode alpha_mode = AlphaMode::opaque;
  bool double_sided = false, unlit = false;
  std::vector<std::string> textures;  // "base colour 1024 x 512", …
};

struct LightInfo {
  std::string name, kind;
  float intensity = 0;  // lux or candela
  std::string unit;
  float range = 0;                 // metres; 0: unlimited
  std::optional<glm::vec2> cones;  // of a spot: half angles of full light and of any, degrees
  std::optional<float> radius;     // metres, of its extras
  std::optional<glm::vec3> place;  // of a spot or a point light, at rest, metres
};

struct CameraInfo {
  std::string name, kind;
};

struct AnimationInfo {
  std::string name;
  float duration = 0;  // seconds
  std::size_t channels = 0;
  bool played = true;  // false: an earlier animation drives the same properties
};

struct SceneInfo {
  std::string name;
  std::size_t nodes = 0, drawn_nodes = 0;  // drawn: reachable in the default scene
  std::size_t meshes = 0, primitives = 0, vertices = 0, morph_targets = 0;
  std::size_t triangles = 0, lines = 0, points = 0;  // as drawn, counted for each instance
  std::size_t instances = 0;                         // of EXT_mesh_gpu_instancing
  std::size_t skins = 0, joints = 0;
  std::size_t textures = 0, images = 0, image_bytes = 0;  // decoded
  Bounds bounds;                                          // metres, at time 0
  std::vector<MaterialInfo> materials;
  std::vector<LightInfo> lights;  // those in the default scene
  std::vector<CameraInfo> cameras;
  std::vector<AnimationInfo> animations;
  std::vector<std::string> extensions;
  std::vector<std::string> unsupported_extensions;  // of those, which are optional: the file is drawn without them
  std::size_t gpu_vertex_bytes = 0, gpu_texture_bytes = 0;  // that GpuScene holds, by gpu_size.h
  std::optional<Bounds> animated_bounds;  // see there; only where the caller has set it, since it takes long
};

SceneInfo describe(const Scene& scene);

// Bounds of all that is drawn while the longest of the played animations runs once, metres: those of up to 121 moments
// at equal distances. Absent: nothing is animated.
std::optional<Bounds> animated_bounds(const Scene& scene);

}  // namespace penumbra::scene
