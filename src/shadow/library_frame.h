#pragma once

#include "programs.h"
#include "technique_frame.h"

namespace penumbra::shadow {

// A mask as the library's own passes hand it on, both the size of the mask: R32UI packed texels (see
// glsl/lib/packed_texel.glsl), and R8UI notes (see LightFrame).
struct PackedMask {
  const gl::Texture& texels;
  const gl::Texture& notes;
};

// What the library's own passes do beyond what a technique's may. Their inputs take units from `first_pass_unit` on.
class LibraryFrame : public TechniqueFrame {
 public:
  using TechniqueFrame::TechniqueFrame;

  // Runs the technique's visibility() into packed texels, with what the history says of each; `last_surfaces` as for
  // bind_history(), null without a history.
  void evaluate_packed(const PackedMask& target, const gl::Texture* last_surfaces) const;
  // Binds what glsl/shadow/history.glsl reads; `last_surfaces`: RG32UI, depth and normal of the last frame's receivers.
  void bind_history(const gl::Texture& last_surfaces) const;
  // Makes a program of the library's current, with the same bound as in use().
  const gl::Program& use_library(gl::Pass& pass, const LibraryProgram& program) const;
};

}  // namespace penumbra::shadow
