#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "../gl/texture.h"
#include "inputs.h"

namespace penumbra::shadow {

// Texture units of the programs that evaluate a technique. Those from `first_pass_unit` to the last are free for the
// inputs of passes; forward surfaces leave them to the caller.
enum TextureUnit : unsigned {
  unit_shadow_map = 0,
  unit_noise,
  unit_receiver_depth,
  unit_receiver_normal,
  first_product_unit,  // in the order in which a technique, recipe or denoiser names its needs
  first_pass_unit = 8,
  // Of the library's own passes.
  unit_motion = first_pass_unit,
  unit_last_surface,
  unit_movement,
  unit_last_texels,
  unit_texels,
  unit_notes,
  unit_count = 16,
};

constexpr unsigned most_products = first_pass_unit - first_product_unit;  // that one can read

// Uniform buffer bindings that the library uses, forward surfaces included.
enum UniformBinding : unsigned { block_params, block_shadow, block_samples, uniform_binding_count };

// What a recipe made of a light in a frame.
struct Product {
  std::string name;  // the recipe's
  const gl::Texture* texture = nullptr;
  gl::SamplerDesc sampler = {};
};

// Everything about one light in one frame that passes and techniques read.
struct LightFrame {
  int view = 0, light = 0;  // ids
  int layer = 0;            // of the mask
  Rect viewport;            // of the receivers' textures and the mask
  LightProjection projection;
  LightShape shape;
  unsigned depth = 0;  // name of the depth array texture, the layers of the projection; 0 when not needed
  const gl::Texture* movement = nullptr;  // see movement_map.h; absent unless a history asks for it
  bool casters_moved = false;             // since the last frame: `movement` shows where
  bool history = false;                   // what the last frame kept may be used
  // R8UI, of masks that went through a denoiser: bits 0 to 3 cascade, 4 kernel smaller than a texel, 5 to 7 why the
  // history was refused (see History in docs/techniques.md).
  const gl::Texture* notes = nullptr;
  std::vector<Product> products;  // all that were made
};

// What the mask holds, layer by layer (one a light): RGBA16F, the size of the depth texture, texel for texel:
// R visibility 0..1; G penumbra radius at the receiver, metres (0: none); B mean distance from receiver to blockers
// along the light, metres (0: none; with a history or filter that which G stands for, also of techniques without one);
// A cascade index, plus 0.5 where the kernel is smaller than a texel. Texels outside of the viewport are undefined. It
// lasts until the next render() of its view.
struct Mask {
  const gl::Texture* texture = nullptr;
  std::vector<LightFrame> lights;
};

}  // namespace penumbra::shadow
