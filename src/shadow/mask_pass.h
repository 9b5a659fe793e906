#pragma once

#include "denoise_context.h"
#include "tiles.h"

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

// Fills the light's layer of the mask with the tiles that decide_all_tiles() decides. The others are listed.
Tiles fill_decided_tiles(const LightWork& work);

// Whether the light has several maps that go on in each other: those of a cube's faces.
bool has_faces(const LightWork& work);
// Whether tiles are listed apart whose receivers may read what others do not: beyond a rim, or the second layer.
bool lists_apart(const LightWork& work);

// Runs the technique's visibility() for the listed pixels of the light's layer of the mask, always in compute shaders.
void run_for_pixels(const LightWork& work, const gl::Buffer& list);

// Binds what glsl/shadow/history.glsl and movement.glsl read; `last_surfaces` as above.
void bind_history(const LightWork& work, const gl::Texture& last_surfaces);

}  // namespace penumbra::shadow
