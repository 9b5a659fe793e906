#include "scene/gltf/schema_rules.h"

#include <utility>

namespace penumbra::scene::gltf {
namespace {

constexpr double most_bytes = 2147483647.0;  // tinygltf stores some offsets as int
constexpr double tiny = 1e-30, half_pi = 1.5707963267948966;

Check boolean() { return {.type = Type::boolean}; }
Check integer(double min, double max) { return {.type = Type::integer, .min = min, .max = max}; }
Check one_of(std::vector<int64_t> values) { return {.type = Type::integer, .values = std::move(values)}; }
Check number(double min = -FLT_MAX, double max = FLT_MAX) { return {.type = Type::number, .min = min, .max = max}; }
Check numbers(std::size_t length, double min = -FLT_MAX, double max = FLT_MAX) {
  return {.type = Type::numbers, .min = min, .max = max, .length = length};
}
Check text(std::vector<std::string> words = {}) { return {.type = Type::text, .words = std::move(words)}; }
Check object() { return {.type = Type::object}; }
Check array() { return {.type = Type::array}; }
Check index(std::string into) { return {.type = Type::index, .into = std::move(into)}; }
Check required(Check check) {
  check.required = true;
  return check;
}

Check required_of(std::string type, Check check) {
  check.of_type = std::move(type);
  return required(std::move(check));
}

void add_texture_rules(std::vector<Rule>& rules, const std::string& path) {
  rules.push_back({path, object()});
  rules.push_back({path + ".index", required(index("textures"))});
  rules.push_back({path + ".texCoord", integer(0, 255)});
  rules.push_back({path + ".scale", number()});
  rules.push_back({path + ".strength", number(0, 1)});
  const std::string transform = path + ".extensions.KHR_texture_transform";
  rules.push_back({transform + ".offset", numbers(2)});
  rules.push_back({transform + ".rotation", number()});
  rules.push_back({transform + ".scale", numbers(2)});
  rules.push_back({transform + ".texCoord", integer(0, 255)});
}

void add_material_rules(std::vector<Rule>& rules) {
  const std::string pbr = "materials[].pbrMetallicRoughness", glossy = "KHR_materials_pbrSpecularGlossiness";
  const std::string old = "materials[].extensions." + glossy;
  const std::vector<Rule> rows = {
      {pbr + ".baseColorFactor", numbers(4, 0, 1)},
      {pbr + ".metallicFactor", number(0, 1)},
      {pbr + ".roughnessFactor", number(0, 1)},
      {"materials[].emissiveFactor", numbers(3, 0)},
      {"materials[].alphaMode", text({"OPAQUE", "MASK", "BLEND"})},
      {"materials[].alphaCutoff", number(0)},
      {"materials[].doubleSided", boolean()},
      {"materials[].extensions.KHR_materials_unlit", object()},
      {"materials[].extensions.KHR_materials_emissive_strength.emissiveStrength", number(0)},
      {old + ".diffuseFactor", numbers(4, 0, 1)},
      {old + ".glossinessFactor", number(0, 1)},
      {"textures[].source", index("images")},
      {"textures[].sampler", index("samplers")},
      {"images[].uri", text()},
      {"images[].bufferView", index("bufferViews")},
      {"samplers[].magFilter", one_of({9728, 9729})},
      {"samplers[].minFilter", one_of({9728, 9729, 9984, 9985, 9986, 9987})},
      {"samplers[].wrapS", one_of({33071, 33648, 10497})},
      {"samplers[].wrapT", one_of({33071, 33648, 10497})},
  };
  rules.insert(rules.end(), rows.begin(), rows.end());
  for (const std::string& path : {pbr + ".baseColorTexture", pbr + ".metallicRoughnessTexture", old + ".diffuseTexture",
                                  std::string("materials[].normalTexture"), std::string("materials[].occlusionTexture"),
                                  std::string("materials[].emissiveTexture")})
    add_texture_rules(rules, path);
}

void add_data_rules(std::vector<Rule>& rules) {
  const std::string meshopt = "bufferViews[].extensions.EXT_meshopt_compression";
  const std::string draco = "meshes[].primitives[].extensions.KHR_draco_mesh_compression";
  const std::vector<Rule> rows = {
      {"buffers[].byteLength", required(integer(1, most_bytes))},
      {"buffers[].uri", text()},
      {"bufferViews[].buffer", required(index("buffers"))},
      {"bufferViews[].byteOffset", integer(0, most_bytes)},
      {"bufferViews[].byteLength", required(integer(1, most_bytes))},
      {"bufferViews[].byteStride", integer(4, 252)},
      {meshopt + ".buffer", required(index("buffers"))},
      {meshopt + ".byteOffset", integer(0, most_bytes)},
      {meshopt + ".byteLength", required(integer(1, most_bytes))},
      {meshopt + ".byteStride", required(integer(1, 256))},
      {meshopt + ".count", required(integer(1, most_bytes))},
      {meshopt + ".mode", required(text({"ATTRIBUTES", "TRIANGLES", "INDICES"}))},
      {meshopt + ".filter", text({"NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL"})},
      {"accessors[].bufferView", index("bufferViews")},
      {"accessors[].byteOffset", integer(0, most_bytes)},
      {"accessors[].componentType", required(one_of({5120, 5121, 5122, 5123, 5125, 5126}))},
      {"accessors[].normalized", boolean()},
      {"accessors[].count", required(integer(1, most_bytes))},
      {"accessors[].type", required(text({"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"}))},
      {"accessors[].sparse.count", required(integer(1, most_bytes))},
      {"accessors[].sparse.indices", required(object())},
      {"accessors[].sparse.indices.bufferView", required(index("bufferViews"))},
      {"accessors[].sparse.indices.byteOffset", integer(0, most_bytes)},
      {"accessors[].sparse.indices.componentType", required(one_of({5121, 5123, 5125}))},
      {"accessors[].sparse.values", required(object())},
      {"accessors[].sparse.values.bufferView", required(index("bufferViews"))},
      {"accessors[].sparse.values.byteOffset", integer(0, most_bytes)},
      {"meshes[].primitives", required(array())},
      {"meshes[].primitives[].attributes", required(object())},
      {"meshes[].primitives[].attributes{}", index("accessors")},
      {"meshes[].primitives[].indices", index("accessors")},
      {"meshes[].primitives[].material", index("materials")},
      {"meshes[].primitives[].mode", integer(0, 6)},
      {"meshes[].primitives[].targets[]", object()},
      {"meshes[].primitives[].targets[]{}", index("accessors")},
      {"meshes[].weights", numbers(0)},
      {draco + ".bufferView", required(index("bufferViews"))},
      {draco + ".attributes", required(object())},
      {draco + ".attributes{}", integer(0, most_bytes)},
  };
  rules.insert(rules.end(), rows.begin(), rows.end());
}

void add_node_rules(std::vector<Rule>& rules) {
  const std::string lights = "extensions.KHR_lights_punctual.lights", spot = lights + "[].spot";
  const std::string instancing = "nodes[].extensions.EXT_mesh_gpu_instancing";
  const std::vector<Rule> rows = {
      {"nodes[].camera", index("cameras")},
      {"nodes[].children[]", index("nodes")},
      {"nodes[].skin", index("skins")},
      {"nodes[].mesh", index("meshes")},
      {"nodes[].matrix", numbers(16)},
      {"nodes[].rotation", numbers(4)},
      {"nodes[].scale", numbers(3)},
      {"nodes[].translation", numbers(3)},
      {"nodes[].weights", numbers(0)},
      {"nodes[].extensions.KHR_lights_punctual.light", required(index(lights))},
      {instancing + ".attributes", required(object())},
      {instancing + ".attributes{}", index("accessors")},
      {"scenes[].nodes[]", index("nodes")},
      {"scene", index("scenes")},
      {"skins[].joints", required(array())},
      {"skins[].joints[]", index("nodes")},
      {"skins[].skeleton", index("nodes")},
      {"skins[].inverseBindMatrices", index("accessors")},
      {"cameras[].type", required(text({"perspective", "orthographic"}))},
      {"cameras[].perspective", required_of("perspective", object())},
      {"cameras[].orthographic", required_of("orthographic", object())},
      {"cameras[].perspective.yfov", required(number(1e-4, 2 * half_pi - 1e-4))},
      {"cameras[].perspective.znear", required(number(tiny))},
      {"cameras[].perspective.zfar", number(tiny)},
      {"cameras[].orthographic.xmag", required(number())},
      {"cameras[].orthographic.ymag", required(number())},
      {"cameras[].orthographic.znear", required(number(0))},
      {"cameras[].orthographic.zfar", required(number(tiny))},
      {lights + "[].type", required(text())},
      {lights + "[].color", numbers(3, 0, 1e6)},
      {lights + "[].intensity", number(0, 1e12)},
      {lights + "[].range", number(0)},
      {spot, required_of("spot", object())},
      {spot + ".innerConeAngle", number(0, half_pi)},
      {spot + ".outerConeAngle", number(tiny, half_pi + 1e-6)},
      {"animations[].channels", required(array())},
      {"animations[].channels[].sampler", required(integer(0, most_bytes))},
      {"animations[].channels[].target", required(object())},
      {"animations[].channels[].target.path", required(text())},
      {"animations[].channels[].target.node", index("nodes")},
      {"animations[].samplers", required(array())},
      {"animations[].samplers[].input", required(index("accessors"))},
      {"animations[].samplers[].output", required(index("accessors"))},
      {"animations[].samplers[].interpolation", text({"LINEAR", "STEP", "CUBICSPLINE"})},
  };
  rules.insert(rules.end(), rows.begin(), rows.end());
}

}  // namespace

const std::vector<Rule>& schema() {
  static const std::vector<Rule> all = [] {
    std::vector<Rule> rules = {
        {"asset", required(object())}, {"asset.version", required(text())}, {"asset.minVersion", text()},
        {"extensionsUsed[]", text()},  {"extensionsRequired[]", text()},
    };
    add_data_rules(rules);
    add_material_rules(rules);
    add_node_rules(rules);
    return rules;
  }();
  return all;
}

}  // namespace penumbra::scene::gltf
