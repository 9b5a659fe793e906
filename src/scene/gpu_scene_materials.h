#pragma once

#include <array>
#include <map>
#include <utility>
#include <vector>

#include "gl/buffer.h"
#include "gl/pass.h"
#include "gl/texture.h"
#include "scene/scene.h"
#include "shared/scene_blocks.h"

namespace penumbra::scene {

// A scene's materials and textures on the GPU. Indices are those of the scene; the last one is glTF's default material.
class Materials {
 public:
  Materials(gl::Device& device, const Scene& scene);

  // Bit i: the material has texture i of glsl/shared/scene_blocks.h.
  unsigned textures_of(int material) const;

  // Those of them that it reads with a transform, or at the second texture coordinates.
  unsigned transforms_of(int material) const;

  void bind(int material) const;  // binds its uniform block and textures

  // For shadow casters: binds its uniform block, and its base colour as a texture of which the shader may use nothing
  // but the alpha. It is read from one finer mip level, without converting colours.
  void bind_alpha(int material) const;

  // The scene's material, or the default for -1.
  static const Material& of(const Scene& scene, int material);
  int index_of(int material) const { return material < 0 ? static_cast<int>(textures_.size()) - 1 : material; }

 private:
  struct Slot {
    const gl::Texture* texture = nullptr;
    const gl::Sampler* sampler = nullptr;
    const gl::Sampler* caster_sampler = nullptr;
  };
  using Slots = std::array<Slot, TEXTURE_COUNT>;

  Slot slot(gl::Device& device, const Scene& scene, const TextureRef& ref, bool srgb);
  Slots slots(gl::Device& device, const Scene& scene, const Material& material);
  void fill_empty_slots();
  void make_alpha_slots();
  void bind_block(int material) const;

  std::map<std::pair<int, bool>, gl::Texture> images_;     // keys: image, and whether it is read as sRGB
  std::vector<Slots> textures_;                            // by material
  std::map<const gl::Texture*, gl::Texture> alpha_views_;  // of base colours, without sRGB
  std::vector<Slot> alpha_;                                // by material: what bind_alpha() binds
  std::vector<unsigned> present_;                          // by material: textures_of()
  std::vector<unsigned> transforms_;                       // by material
  gl::Buffer blocks_;
};

}  // namespace penumbra::scene
