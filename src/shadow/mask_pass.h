#pragma once

#include "denoise_context.h"

namespace penumbra::shadow {

// Where the mask pass writes: a layer of an array in the mask's format or its other one, or the packed form of a mask.
struct MaskOutput {
  const gl::Texture* mask = nullptr;
  int layer = 0;
  const PackedMask* packed = nullptr;          // instead of `mask`
  const gl::Texture* last_surfaces = nullptr;  // of `packed`, see DenoiseContext::evaluate_packed(); may be null
};

// Runs the technique's visibility() for every pixel, or for those of the tiles that a penumbra can reach (see tiles.h),
// with fragment or compute shaders as the parameter "driver" says. Returns Tiles::decisions, or null where no
// tiles were decided.
const gl::Texture* run_mask_pass(const LightWork& work, const MaskOutput& output);

// The pixels of a mask that are yet to be computed: RG32UI, one texel a tile of 8 × 8, bit 8 y + x for each pixel; and
// a list of the tiles that have any.
struct MissingPixels {
  const gl::Texture& pixels;
  const gl::Buffer& list;
};

// Runs the technique's visibility() for these pixels of the light's layer of the mask, always in fragment shaders.
void run_for_missing(const LightWork& work, const MissingPixels& missing);

// Binds what glsl/shadow/history.glsl and movement.glsl read; `last_surfaces` as above.
void bind_history(const LightWork& work, const gl::Texture& last_surfaces);

}  // namespace penumbra::shadow
