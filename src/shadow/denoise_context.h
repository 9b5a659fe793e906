#pragma once

#include <vector>

#include "filter.h"
#include "pass_context.h"

namespace penumbra::shadow {

// Which parts of a mask have blockers: filters leave the others as they are (see list_filter_tiles).
struct BlockerDistances {
  const gl::Texture* texels = nullptr;     // packed, from the technique
  const gl::Texture* decisions = nullptr;  // Tiles::decisions; null where no tiles were decided
};

// The intermediate form of a mask between a denoiser's steps: packed texels (see glsl/lib/packed_texel.glsl) beside the
// bits of their pixels' stored depths, as texel_with_depth() of glsl/shadow/drivers/gbuffer.glsl makes them, and R8UI
// notes (see LightFrame::notes), both of the mask's size.
constexpr GLenum packed_format = GL_RG32UI;
struct PackedMask {
  const gl::Texture& texels;
  const gl::Texture& notes;
  // The technique's own texels. Whoever changes them hands this on with the result, if distances spread at most to the
  // neighbours of pixels that have one, and none becomes greater than those; else filters have to run for all pixels,
  // as they do where there are none.
  BlockerDistances distances = {};
};

// PassContext with the additional steps that only denoisers use.
class DenoiseContext : public PassContext {
 public:
  using PassContext::PassContext;

  // The history of a texture that Denoiser::remembers lists, to be called in every frame in which it is listed. Not
  // valid either where casters may have moved and no movement map shows where (see Inputs::moved).
  History remembered(std::string_view name) const;
  // The technique's result as packed texels and notes: computed by its visibility(), or converted from the layer of the
  // mask that its `resolve` filled. With `last_surfaces` (RG32UI, the surface_bits() of glsl/shadow/history.glsl of the
  // last frame), each pixel's note says whether its history is valid, so that techniques can take more sample points
  // where it is not.
  PackedMask evaluate_packed(const gl::Texture* last_surfaces = nullptr) const;
  // Packed texels after all passes of a filter; "none": those of `source`. Filters may follow each other: each call has
  // textures of its own, whose contents last until the next frame.
  const gl::Texture& filter(std::string_view filter, const PackedMask& source) const;
  // Fills the mask's layer (see Mask): packed texels after all passes of a filter, or as they are for "none".
  void filter_to_mask(std::string_view filter, const PackedMask& source) const;
  // Binds what glsl/shadow/history.glsl and movement.glsl read; `last_surfaces` as above.
  void bind_history(const gl::Texture& last_surfaces) const;

 private:
  void pack(const PackedMask& target, const gl::Texture* last_surfaces) const;
  const gl::Buffer& changing_tiles(const BlockerDistances& distances, Filter::Keeps keeps) const;
  const gl::Texture& run(const Filter& filter, const PackedMask& source, bool to_mask) const;

  mutable int filters_run_ = 0;  // in this frame
  // Of this frame, once a filter has asked for them: the tiles that filters change, and by what they were found.
  struct Listed {
    const gl::Texture* distances;
    Filter::Keeps keeps;
    const gl::Buffer* tiles;
  };
  mutable std::vector<Listed> listed_;
};

}  // namespace penumbra::shadow
