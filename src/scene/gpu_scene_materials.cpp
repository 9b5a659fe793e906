#include "scene/gpu_scene_materials.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/mip_levels.h"

namespace penumbra::scene {

static_assert(sizeof(glsl::MaterialBlock) == 256);

namespace {

constexpr GLuint material_binding = 6;  // must match glsl/scene/material.glsl
constexpr GLuint first_unit = 8;

std::array<const TextureRef*, TEXTURE_COUNT> references(const Material& material) {
  return {&material.base_color_texture, &material.metallic_roughness_texture, &material.normal_texture,
          &material.occlusion_texture, &material.emissive_texture};
}

bool holds_color(std::size_t which) { return which == TEXTURE_BASE_COLOR || which == TEXTURE_EMISSIVE; }

float cutoff_of(const Material& material) {
  // A blended surface casts a shadow where its alpha is above a half.
  if (material.alpha_mode == AlphaMode::blend) return std::nextafter(0.5f, 1.0f);
  return material.alpha_mode == AlphaMode::mask ? material.alpha_cutoff : -1.0f;
}

// `textures`: bit i: it has texture i.
glsl::MaterialBlock block_of(const Material& material, unsigned textures) {
  const auto has = [textures](int which) { return (textures >> which & 1u) != 0 ? 1.0f : 0.0f; };
  glsl::MaterialBlock block{.base_color = material.base_color,
                            .emissive = material.emissive,
                            .alpha_cutoff = cutoff_of(material),
                            .metallic = material.metallic,
                            .roughness = material.roughness,
                            .normal_scale = material.normal_scale,
                            .occlusion_strength = material.occlusion_strength * has(TEXTURE_OCCLUSION),
                            .has_base_color = has(TEXTURE_BASE_COLOR),
                            .has_metallic_roughness = has(TEXTURE_METALLIC_ROUGHNESS),
                            .has_emissive = has(TEXTURE_EMISSIVE)};
  if (material.unlit) block.flags |= MATERIAL_UNLIT;
  const auto refs = references(material);
  for (std::size_t i = 0; i < refs.size(); ++i) {
    const TextureRef& ref = *refs[i];
    if (ref.uv_set == 1) block.flags |= 1u << i;
    const glm::mat3x2& m = ref.uv_transform;
    for (glm::length_t row = 0; row < 2; ++row) {
      block.uv_rows[2 * i + static_cast<std::size_t>(row)] = glm::vec4(m[0][row], m[1][row], m[2][row], 0.0f);
    }
  }
  return block;
}

// Bit i: texture i is read otherwise than at the first texture coordinates as they are.
unsigned transforms_in(const Material& material) {
  unsigned transforms = 0;
  const auto refs = references(material);
  for (std::size_t i = 0; i < refs.size(); ++i) {
    if (refs[i]->uv_set == 1 || refs[i]->uv_transform != TextureRef{}.uv_transform) transforms |= 1u << i;
  }
  return transforms;
}

gl::Texture upload(const Image& image, bool srgb) {
  const GLenum format = srgb ? GL_SRGB8_ALPHA8 : GL_RGBA8;
  // Not by glGenerateTextureMipmap(): drivers round in different ways, up to 3 of 255 off, and software drivers compile
  // shaders for it.
  const std::vector<MipLevel> levels = mip_levels(image, srgb);
  gl::Texture texture(
      image.name.empty() ? "image" : image.name,
      {.format = format, .width = image.width, .height = image.height, .levels = static_cast<int>(levels.size()) + 1});
  texture.upload(GL_RGBA, GL_UNSIGNED_BYTE, std::as_bytes(std::span(image.rgba)));
  for (int level = 1; const MipLevel& smaller : levels)
    texture.upload(GL_RGBA, GL_UNSIGNED_BYTE, std::as_bytes(std::span(smaller.rgba)), level++);
  return texture;
}

GLenum wrap_of(Wrap wrap) {
  switch (wrap) {
    case Wrap::repeat:
      return GL_REPEAT;
    case Wrap::mirrored_repeat:
      return GL_MIRRORED_REPEAT;
    case Wrap::clamp_to_edge:
      break;
  }
  return GL_CLAMP_TO_EDGE;
}

gl::SamplerDesc sampler_of(const Texture& texture) {
  const bool linear = texture.min == Filter::linear;
  GLenum min = linear ? GL_LINEAR : GL_NEAREST;
  if (texture.mipmapped && texture.mip == Filter::linear) {
    min = linear ? GL_LINEAR_MIPMAP_LINEAR : GL_NEAREST_MIPMAP_LINEAR;
  } else if (texture.mipmapped) {
    min = linear ? GL_LINEAR_MIPMAP_NEAREST : GL_NEAREST_MIPMAP_NEAREST;
  }
  const GLenum mag = texture.mag == Filter::linear ? GL_LINEAR : GL_NEAREST;
  return {.min_filter = min, .mag_filter = mag, .wrap_s = wrap_of(texture.wrap_s), .wrap_t = wrap_of(texture.wrap_t)};
}

// Casters read their alpha from finer mip levels than pictures: in coarse ones leaves shrink, because what is mixed
// from their texels passes the alpha test less often. See ADR 25.
constexpr float caster_lod_bias = -1.5f;

// One mip level instead of two.
gl::SamplerDesc caster_sampler(gl::SamplerDesc sampler) {
  if (sampler.min_filter == GL_LINEAR_MIPMAP_LINEAR) sampler.min_filter = GL_LINEAR_MIPMAP_NEAREST;
  if (sampler.min_filter == GL_NEAREST_MIPMAP_LINEAR) sampler.min_filter = GL_NEAREST_MIPMAP_NEAREST;
  sampler.lod_bias = caster_lod_bias;
  return sampler;
}

}  // namespace

Materials::Materials(gl::Device& device, const Scene& scene) {
  std::vector<glsl::MaterialBlock> blocks;
  for (const Material& material : scene.materials) {
    textures_.push_back(slots(device, scene, material));
    unsigned& present = present_.emplace_back(0u);
    for (std::size_t i = 0; i < TEXTURE_COUNT; ++i) {
      if (textures_.back()[i].texture != nullptr) present |= 1u << i;
    }
    transforms_.push_back(present & transforms_in(material));
    blocks.push_back(block_of(material, present));
  }
  blocks.push_back(block_of(of(scene, -1), 0));
  textures_.emplace_back();
  present_.push_back(0);
  transforms_.push_back(0);
  fill_empty_slots();
  make_alpha_slots();
  blocks_ = gl::Buffer::of("materials", std::span<const glsl::MaterialBlock>(blocks));
}

unsigned Materials::textures_of(int material) const { return present_[static_cast<std::size_t>(index_of(material))]; }

unsigned Materials::transforms_of(int material) const {
  return transforms_[static_cast<std::size_t>(index_of(material))];
}

const Material& Materials::of(const Scene& scene, int material) {
  static const Material unspecified;
  return material < 0 ? unspecified : scene.materials[static_cast<std::size_t>(material)];
}

Materials::Slots Materials::slots(gl::Device& device, const Scene& scene, const Material& material) {
  Slots slots;
  const auto refs = references(material);
  for (std::size_t i = 0; i < refs.size(); ++i) slots[i] = slot(device, scene, *refs[i], holds_color(i));
  return slots;
}

Materials::Slot Materials::slot(gl::Device& device, const Scene& scene, const TextureRef& ref, bool srgb) {
  if (ref.texture < 0) return {};
  const Texture& texture = scene.textures[static_cast<std::size_t>(ref.texture)];
  if (texture.image < 0) return {};
  auto [entry, added] = images_.try_emplace({texture.image, srgb});
  if (added) entry->second = upload(scene.images[static_cast<std::size_t>(texture.image)], srgb);
  return {&entry->second, &device.sampler(sampler_of(texture)), &device.sampler(caster_sampler(sampler_of(texture)))};
}

// Shaders may sample textures that a material lacks, and cancel them by a factor of 0. So that what they read is
// finite, another material's texture is bound there. A software driver also recompiles a shader for each combination of
// texture states that it is drawn with.
void Materials::fill_empty_slots() {
  for (std::size_t i = 0; i < TEXTURE_COUNT; ++i) {
    const auto filled =
        std::ranges::find_if(textures_, [&](const Slots& slots) { return slots[i].texture != nullptr; });
    if (filled == textures_.end()) continue;
    for (Slots& slots : textures_) {
      if (slots[i].texture == nullptr) slots[i] = (*filled)[i];
    }
  }
}

void Materials::make_alpha_slots() {
  for (const Slots& slots : textures_) {
    Slot& slot = alpha_.emplace_back(slots[TEXTURE_BASE_COLOR]);
    if (slot.texture == nullptr) continue;
    const auto [view, added] = alpha_views_.try_emplace(slot.texture);
    if (added) view->second = gl::Texture::view("alpha", *slot.texture, GL_RGBA8);
    slot.texture = &view->second;
  }
}

void Materials::bind_block(int material) const {
  constexpr std::size_t size = sizeof(glsl::MaterialBlock);
  gl::glBindBufferRange(GL_UNIFORM_BUFFER, material_binding, blocks_.id(),
                        static_cast<GLintptr>(size * static_cast<std::size_t>(material)), size);
}

void Materials::bind_alpha(int material) const {
  bind_block(material);
  const Slot& slot = alpha_[static_cast<std::size_t>(material)];
  if (slot.texture == nullptr) return;
  slot.texture->bind(first_unit + TEXTURE_BASE_COLOR);
  slot.caster_sampler->bind(first_unit + TEXTURE_BASE_COLOR);
}

void Materials::bind(int material) const {
  bind_block(material);
  const Slots& slots = textures_[static_cast<std::size_t>(material)];
  for (GLuint i = 0; i < slots.size(); ++i) {
    if (slots[i].texture == nullptr) continue;
    slots[i].texture->bind(first_unit + i);
    slots[i].sampler->bind(first_unit + i);
  }
}

}  // namespace penumbra::scene
