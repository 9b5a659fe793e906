#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>

#include "core/log.h"
#include "scene/gltf/images.h"
#include "scene/gltf/read.h"

namespace penumbra::scene::gltf {
namespace {

using tinygltf::Value;

glm::vec4 to_vec4(const std::vector<double>& v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2]), static_cast<float>(v[3])};
}

// uv' = translation · rotation · scale · uv. Counter-clockwise as seen on the image, whose v grows downwards.
glm::mat3x2 uv_matrix(const Value& transform) {
  const auto offset = numbers_or(transform, "offset", {0, 0}), scale = numbers_or(transform, "scale", {1, 1});
  const double angle = number_or(transform, "rotation", 0), c = std::cos(angle), s = std::sin(angle);
  return {static_cast<float>(c * scale[0]), static_cast<float>(-s * scale[0]), static_cast<float>(s * scale[1]),
          static_cast<float>(c * scale[1]), static_cast<float>(offset[0]),     static_cast<float>(offset[1])};
}

// While a material is being read, uv_set is the file's number of the UV set.
TextureRef reference(int texture, int uv_set, const Value* transform) {
  TextureRef ref{.texture = texture, .uv_set = uv_set};
  if (transform == nullptr || !transform->IsObject()) return ref;
  ref.uv_set = index_or(*transform, "texCoord", uv_set);
  ref.uv_transform = uv_matrix(*transform);
  return ref;
}

template <class TextureInfo>
TextureRef reference(const TextureInfo& info) {
  return reference(info.index, info.texCoord, find_extension(info, "KHR_texture_transform"));
}

// The same, from an extension's object.
TextureRef reference(const Value& object, const char* key) {
  if (!object.Has(key)) return {};
  const Value& info = object.Get(key);
  const Value* transform = nullptr;
  if (info.Has("extensions") && info.Get("extensions").Has("KHR_texture_transform"))
    transform = &info.Get("extensions").Get("KHR_texture_transform");
  return reference(index_or(info, "index", -1), index_or(info, "texCoord", 0), transform);
}

// The deprecated specular-glossiness workflow has no exact equivalent: its diffuse part is kept, its specular colour is
// dropped.
void read_specular_glossiness(const Value& old, Material& material) {
  material.base_color = to_vec4(numbers_or(old, "diffuseFactor", {1, 1, 1, 1}));
  material.base_color_texture = reference(old, "diffuseTexture");
  material.metallic = 0;
  material.roughness = 1 - static_cast<float>(number_or(old, "glossinessFactor", 1));
  material.metallic_roughness_texture = {};
}

std::array<TextureRef*, 5> references(Material& m) {
  return {&m.base_color_texture, &m.metallic_roughness_texture, &m.normal_texture, &m.occlusion_texture,
          &m.emissive_texture};
}

// Assigns the first two UV sets that the material uses to its two slots.
void assign_uv_slots(MaterialUse& use) {
  std::vector<int> sets;
  for (const TextureRef* ref : references(use.material))
    if (ref->texture >= 0 && std::find(sets.begin(), sets.end(), ref->uv_set) == sets.end())
      sets.push_back(ref->uv_set);
  if (std::all_of(sets.begin(), sets.end(), [](int set) { return set < 2; })) return;
  if (sets.size() > 2)
    warn("material '{}' uses {} UV sets; its textures beyond the second set use TEXCOORD_{}", use.material.name,
         sets.size(), sets[0]);
  for (std::size_t slot = 0; slot < 2; ++slot) use.uv_sets[slot] = sets[std::min(slot, sets.size() - 1)];
  for (TextureRef* ref : references(use.material)) ref->uv_set = sets.size() > 1 && ref->uv_set == sets[1] ? 1 : 0;
}

MaterialUse read_material(const tinygltf::Material& in, std::size_t number) {
  MaterialUse use;
  Material& out = use.material;
  const auto& pbr = in.pbrMetallicRoughness;
  out.name = in.name;
  out.base_color = to_vec4(pbr.baseColorFactor);
  out.base_color_texture = reference(pbr.baseColorTexture);
  out.metallic = static_cast<float>(pbr.metallicFactor);
  out.roughness = static_cast<float>(pbr.roughnessFactor);
  out.metallic_roughness_texture = reference(pbr.metallicRoughnessTexture);
  if (const Value* old = find_extension(in, "KHR_materials_pbrSpecularGlossiness"); old && old->IsObject())
    read_specular_glossiness(*old, out);
  out.normal_texture = reference(in.normalTexture);
  out.normal_scale = static_cast<float>(in.normalTexture.scale);
  out.occlusion_texture = reference(in.occlusionTexture);
  out.occlusion_strength = static_cast<float>(in.occlusionTexture.strength);
  out.emissive = glm::vec3(in.emissiveFactor[0], in.emissiveFactor[1], in.emissiveFactor[2]);
  if (const Value* strength = find_extension(in, "KHR_materials_emissive_strength"); strength && strength->IsObject())
    out.emissive *= static_cast<float>(number_or(*strength, "emissiveStrength", 1));
  // Clamped to far more than any display shows, but still finite after lighting.
  out.emissive = glm::min(out.emissive, glm::vec3(1e9f));
  out.emissive_texture = reference(in.emissiveTexture);
  if (in.alphaMode == "MASK") out.alpha_mode = AlphaMode::mask;
  if (in.alphaMode == "BLEND") out.alpha_mode = AlphaMode::blend;
  out.alpha_cutoff = static_cast<float>(in.alphaCutoff);
  out.double_sided = in.doubleSided;
  out.unlit = find_extension(in, "KHR_materials_unlit") != nullptr;
  out.casting = casting_of_extras(in.extras, fmt::format("materials[{}]", number));
  assign_uv_slots(use);
  return use;
}

Wrap to_wrap(int gl) {
  if (gl == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Wrap::clamp_to_edge;
  return gl == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Wrap::mirrored_repeat : Wrap::repeat;
}

Texture read_texture(const Document& document, const tinygltf::Texture& in) {
  Texture out;
  if (in.sampler < 0) return out;
  const tinygltf::Sampler& sampler = document.model.samplers[static_cast<std::size_t>(in.sampler)];
  out.wrap_s = to_wrap(sampler.wrapS);
  out.wrap_t = to_wrap(sampler.wrapT);
  const auto is = [&](int a, int b) { return sampler.minFilter == a || sampler.minFilter == b; };
  if (sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST) out.mag = Filter::nearest;
  if (is(TINYGLTF_TEXTURE_FILTER_NEAREST, TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST) ||
      sampler.minFilter == TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_LINEAR)
    out.min = Filter::nearest;
  if (is(TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST, TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_NEAREST))
    out.mip = Filter::nearest;
  out.mipmapped = !is(TINYGLTF_TEXTURE_FILTER_NEAREST, TINYGLTF_TEXTURE_FILTER_LINEAR);
  return out;
}

// The file's index of a reference's image; -1 for none.
int image_of(const Document& document, const TextureRef& ref) {
  return document.model.textures[static_cast<std::size_t>(ref.texture)].source;
}

}  // namespace

std::vector<MaterialUse> read_materials(const Document& document) {
  std::vector<MaterialUse> materials;
  for (const tinygltf::Material& material : document.model.materials)
    materials.push_back(read_material(material, materials.size()));
  return materials;
}

void read_textures(Document& document, const ImageDecoder& decode, std::vector<MaterialUse>& materials, Scene& scene) {
  for (const tinygltf::Texture& texture : document.model.textures)
    scene.textures.push_back(read_texture(document, texture));
  ImageReader images(document, decode, scene);
  for (MaterialUse& use : materials)
    for (const TextureRef* ref : references(use.material))
      if (ref->texture >= 0) images.need(image_of(document, *ref));
  images.read();
  std::set<int> told;  // textures
  for (MaterialUse& use : materials) {
    for (TextureRef* ref : references(use.material)) {
      if (ref->texture < 0) continue;
      const int source = image_of(document, *ref);
      if (source < 0 && told.insert(ref->texture).second)
        warn("material '{}': textures[{}] has no image that can be read; left out", use.material.name, ref->texture);
      const int image = source < 0 ? -1 : images.number(source);
      if (image < 0)
        ref->texture = -1;
      else
        scene.textures[static_cast<std::size_t>(ref->texture)].image = image;
    }
    scene.materials.push_back(use.material);
  }
}

}  // namespace penumbra::scene::gltf
