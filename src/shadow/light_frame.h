#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "../gl/texture.h"
#include "inputs.h"

namespace penumbra::shadow {

// Texture units of the programs that evaluate a technique. Units from `first_pass_unit` on are for the inputs of single
// passes; in forward programs they belong to the caller.
enum TextureUnit : unsigned {
  unit_shadow_map = 0,
  unit_noise,
  unit_receiver_depth,
  unit_receiver_normal,
  first_product_unit,  // in the order in which a technique, recipe or denoiser names its needs
  first_pass_unit = 8,
  // Used by the library's own passes.
  unit_motion = first_pass_unit,
  unit_last_surface,
  unit_movement,
  unit_last_texels,
  unit_texels,
  unit_notes,
  unit_decisions,
  unit_count = 16,
};

constexpr unsigned most_products =
    first_pass_unit - first_product_unit;  // that a technique, recipe or denoiser can read

// Uniform buffer bindings that the library uses, forward surfaces included.
enum UniformBinding : unsigned { block_params, block_shadow, block_samples, uniform_binding_count };

// A texture that a recipe made for one light in one frame.
struct Product {
  std::string name;                      // the recipe's
  const gl::Texture* texture = nullptr;  // null: the recipe does not apply (Recipe::applies)
  gl::SamplerDesc sampler = {};
};

// The data of one light in one frame that passes and techniques read.
struct LightFrame {
  int view = 0, light = 0;  // ids
  int layer = 0;            // of the mask
  Rect viewport;            // of the receivers' textures and the mask
  LightProjection projection;
  LightShape shape;
  // OpenGL name of the shadow map, one array layer for each layer of the projection; 0 if nothing needs it.
  unsigned depth = 0;
  // The layers of the shadow map that were not drawn because they hold the same as in the last frame.
  LayerSet kept_layers;
  const gl::Texture* movement = nullptr;  // see movement_map.h; null unless a history uses it
  bool casters_moved = false;             // since the last frame: `movement` shows where
  bool history = false;                   // the history of the last frame is valid
  bool binds_forward = true;              // as in Inputs
  bool borders_are_edges = true;          // of the shadow map's layers but the last one, in the least_depth_pyramid
  int scale = 1;                          // of the mask that the technique filled: see mask_scale.h
  // R8UI, of the size of that mask, only if a denoiser ran: bits 0 to 2 the layer of the shadow map that was read, bit
  // 3 set if the shadow is narrow (docs/adr/0033-mask-scale.md; never if `scale` is 1), bit 4 set if the kernel is
  // smaller than a texel of the map (bits 0 to 2 and 4 are complete only where the mask has details), bits 5 to 7 why
  // the history was rejected (see History in docs/techniques.md).
  const gl::Texture* notes = nullptr;
  std::vector<Product> products;  // all that this frame made for the light
};

// The result: an array with one layer for each light, of the size of the depth texture, one texel for each of its
// pixels. R is visibility, 0..1, and by default there is no more: R16F. With Inputs::mask_details, and where a light's
// technique fills the mask by passes of its own (Technique::resolve), it is RGBA16F: G penumbra radius at the receiver,
// metres (0: none); B mean distance from receiver to blockers along the light, metres (0: none; after a denoiser, the
// distance that corresponds to the radius in G, also for techniques that compute only the radius); A the layer of
// the shadow map that was read (for a sun its cascade, 0 the finest), plus 0.5 where the kernel is smaller than a
// texel. Texels outside of the viewport are undefined. The mask is valid until the next render() of its view.
struct Mask {
  const gl::Texture* texture = nullptr;
  std::vector<LightFrame> lights;
};

}  // namespace penumbra::shadow
