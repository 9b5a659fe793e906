#include "library_frame.h"

#include "light_state.h"

namespace penumbra::shadow {

static_assert(unit_motion == 8 && unit_last_surface == 9 && unit_movement == 10 && unit_last_texels == 11 &&
                  unit_texels == 12 && unit_notes == 13,
              "glsl/shadow/history.glsl, movement.glsl and drivers have these numbers");

void LibraryFrame::evaluate_packed(const PackedMask& target, const gl::Texture* last_surfaces) const {
  gl::PassDesc desc{.name = "shadow mask"};
  if (!uses_compute()) desc.colors = {{.texture = &target.texels}, {.texture = &target.notes}};
  gl::Pass pass(device(), desc);
  pass.use(parts_.programs.mask(parts_.technique, params(),
                                {.rotated = parts_.state.rotated,
                                 .compute = uses_compute(),
                                 .packed = true,
                                 .history = last_surfaces != nullptr}));
  bind_inputs();
  if (last_surfaces != nullptr) bind_history(*last_surfaces);
  if (uses_compute()) {
    target.texels.bind_image(0, GL_WRITE_ONLY);
    target.notes.bind_image(1, GL_WRITE_ONLY);
  }
  cover(pass);
}

void LibraryFrame::bind_history(const gl::Texture& last_surfaces) const {
  const gl::Texture* movement = frame().movement;
  for (const GLuint unit : {unit_motion, unit_last_surface, unit_movement}) device().sampler({}).bind(unit);
  gl::glBindTextureUnit(unit_motion, inputs().motion.id);
  last_surfaces.bind(unit_last_surface);
  gl::glBindTextureUnit(unit_movement, movement != nullptr ? movement->id() : 0);
}

const gl::Program& LibraryFrame::use_library(gl::Pass& pass, const LibraryProgram& program) const {
  const gl::Program& used = pass.use(parts_.programs.ready(program));
  bind_inputs();
  return used;
}

}  // namespace penumbra::shadow
