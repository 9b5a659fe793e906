#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <string>
#include <vector>

namespace penumbra::scene {

// Plain scene data as a glTF file describes it, without GL objects or files. Units: metres, seconds, radians. +Y up,
// right-handed. Indices refer to the vectors of Scene. A reader guarantees that every index is in range, every vertex
// index is below the vertex count, the node graph is a forest without cycles, and every number is finite.

enum class Wrap : uint8_t { repeat, mirrored_repeat, clamp_to_edge };
enum class Filter : uint8_t { nearest, linear };

struct Image {
  std::string name;
  int width = 1, height = 1;
  std::vector<uint8_t> rgba;  // 8-bit, rows top to bottom as glTF's (0,0) is the upper left
};

struct Texture {
  int image = -1;
  Wrap wrap_s = Wrap::repeat, wrap_t = Wrap::repeat;
  Filter mag = Filter::linear, min = Filter::linear, mip = Filter::linear;
  bool mipmapped = true;
};

// A texture as a material uses it: the UV set, and KHR_texture_transform as a 2×3 affine matrix.
struct TextureRef {
  int texture = -1;                            // -1: none
  int uv_set = 0;                              // 0 or 1
  glm::mat3x2 uv_transform{1, 0, 0, 1, 0, 0};  // uv' = uv_transform · (u, v, 1)
};

enum class AlphaMode : uint8_t { opaque, mask, blend };

// Which triangles cast shadows: those whose front faces the light (glTF: counter-clockwise), those whose back does, or
// all.
enum class CasterFaces : uint8_t { both, front, back };

// How the surfaces of a material or a node cast shadows; a node's setting overrides its material's.
enum class CastSetting : uint8_t {
  automatic,  // as the renderer's parameters say, but skies (Node::sky) cast none
  on,         // as the parameters say, also for skies
  off,
  both,  // these faces, whatever the parameters say; also for skies
  front,
  back,
};

struct Material {
  std::string name;
  glm::vec4 base_color{1};
  TextureRef base_color_texture;
  float metallic = 1, roughness = 1;
  TextureRef metallic_roughness_texture;  // G roughness, B metallic
  TextureRef normal_texture;
  float normal_scale = 1;
  TextureRef occlusion_texture;  // R
  float occlusion_strength = 1;
  glm::vec3 emissive{0};  // times KHR_materials_emissive_strength
  TextureRef emissive_texture;
  AlphaMode alpha_mode = AlphaMode::opaque;
  float alpha_cutoff = 0.5f;
  bool double_sided = false;
  bool unlit = false;                            // KHR_materials_unlit
  CastSetting casting = CastSetting::automatic;  // extras: "penumbra_casts"
  bool casting_over_nodes = false;               // the material's setting overrides that of nodes
};

enum class Topology : uint8_t { points, lines, triangles };  // strips, fans and loops are expanded by the reader

struct MorphTarget {
  std::vector<glm::vec3> positions, normals, tangents;  // offsets; empty or one for each vertex
};

// A drawable. Vertex attributes are empty or have one entry per vertex. Positions and normals are never empty: where
// the file has no normals, the reader splits vertices and generates flat ones. Tangents (w = handedness) are generated
// where a normal map needs them.
struct Primitive {
  Topology topology = Topology::triangles;
  std::vector<uint32_t> indices;  // never empty
  std::vector<glm::vec3> positions, normals;
  std::vector<glm::vec4> tangents;
  std::array<std::vector<glm::vec2>, 2> uvs;
  std::vector<glm::vec4> colors;  // linear RGBA
  std::vector<glm::u16vec4> joints;
  std::vector<glm::vec4> weights;  // sum to 1
  std::vector<MorphTarget> targets;
  int material = -1;  // -1: glTF's default material
};

struct Mesh {
  std::string name;
  std::vector<Primitive> primitives;
  std::vector<float> default_weights;  // one for each morph target
};

struct Transform {
  glm::vec3 translation{0};
  glm::quat rotation{1, 0, 0, 0};
  glm::vec3 scale{1};
};

struct Node {
  std::string name;
  int parent = -1;
  std::vector<int> children;
  Transform transform;              // used unless `matrix`
  std::optional<glm::mat4> matrix;  // the file's matrix, unchanged, since it may contain shear
  int mesh = -1, skin = -1, camera = -1, light = -1;
  CastSetting casting = CastSetting::automatic;  // extras: "penumbra_casts"
  bool sky = false;                  // a shell, such as a sky dome, around everything else that is drawn: see sky.h
  bool ground = false;               // a level plane on which everything else stands
  std::vector<float> weights;        // overrides the mesh's default weights
  std::vector<Transform> instances;  // EXT_mesh_gpu_instancing; empty: a single instance at the node
};

struct Skin {
  std::string name;
  std::vector<int> joints;  // nodes
  std::vector<glm::mat4> inverse_bind;
};

struct Camera {
  std::string name;
  bool orthographic = false;
  float fov_y = 0.8f;                     // perspective
  float half_width = 1, half_height = 1;  // orthographic
  float near = 0.1f;
  std::optional<float> far;  // absent: infinite
};

enum class LightKind : uint8_t { directional, point, spot };

// A light as the file describes it (KHR_lights_punctual), at the place of the nodes that name it.
struct PunctualLight {
  std::string name;
  LightKind kind = LightKind::directional;
  glm::vec3 color{1};   // linear
  float intensity = 1;  // lux for directional, candela for point and spot
  float range = 0;      // 0: infinite
  float inner_cone = 0, outer_cone = 0.7853982f;
  std::optional<float> radius = {};  // metres, of the sphere that emits light: "radius" of its extras
};

enum class Path : uint8_t { translation, rotation, scale, weights };
enum class Interpolation : uint8_t { step, linear, cubic_spline };

struct AnimationChannel {
  int node = -1;
  Path path = Path::translation;
  Interpolation interpolation = Interpolation::linear;
  std::vector<float> times;   // seconds, never falling; at a time of several keys the last one holds, for a jump
  std::vector<float> values;  // keys × components (× 3 for cubic_spline: in-tangent, value, out-tangent)
  int components = 3;         // 3, 4 (quaternion xyzw) or the number of morph targets
};

struct Animation {
  std::string name;
  std::vector<AnimationChannel> channels;
  float duration = 0;
};

struct Scene {
  std::string name;
  std::vector<std::filesystem::path> files;  // all files that it was read from: the glTF, its buffers and images
  std::vector<Image> images;
  std::vector<Texture> textures;
  std::vector<Material> materials;
  std::vector<Mesh> meshes;
  std::vector<Node> nodes;
  std::vector<int> roots;  // of the file's default scene (or its first); other nodes are not drawn
  std::vector<Skin> skins;
  std::vector<Camera> cameras;
  std::vector<PunctualLight> lights;
  std::vector<Animation> animations;
  std::vector<std::string> extensions_used;
};

}  // namespace penumbra::scene
