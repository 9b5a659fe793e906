#pragma once

#include "pass_context.h"

namespace penumbra::shadow {

// A mask on its way through a denoiser: R32UI packed texels (see glsl/lib/packed_texel.glsl), and R8UI notes (see
// LightFrame), both the size of the mask.
struct PackedMask {
  const gl::Texture& texels;
  const gl::Texture& notes;
};

// What a denoiser's steps do beyond what a technique's may.
class DenoiseContext : public PassContext {
 public:
  using PassContext::PassContext;

  // What Denoiser::remembers lists.
  History remembered(std::string_view name) const;
  // What the technique computed, as packed texels and notes: of its visibility(), or of the mask's layer as its
  // `resolve` left it. With `last_surfaces`, each pixel's note says whether its history holds, so that techniques can
  // take more points where it does not: RG32UI, what surface_bits() of glsl/shadow/history.glsl gave in the last frame.
  PackedMask evaluate_packed(const gl::Texture* last_surfaces = nullptr) const;
  // Packed texels after all passes of a filter; "none": `source` itself. R32UI, the size of the mask.
  const gl::Texture& filter(std::string_view filter, const gl::Texture& source) const;
  // Fills the mask's layer (see Mask): packed texels after all passes of a filter, or as they are for "none".
  void filter_to_mask(std::string_view filter, const PackedMask& source) const;
  // Binds what glsl/shadow/history.glsl and movement.glsl read; `last_surfaces` as above.
  void bind_history(const gl::Texture& last_surfaces) const;

 private:
  void run_mask_pass(const PackedMask& target, const gl::Texture* last_surfaces) const;
};

}  // namespace penumbra::shadow
