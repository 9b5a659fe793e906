#include "denoise_context.h"

#include <fmt/format.h>

#include <stdexcept>

#include "filters.h"
#include "light_work.h"

namespace penumbra::shadow {

static_assert(unit_motion == 8 && unit_last_surface == 9 && unit_movement == 10 && unit_last_texels == 11 &&
                  unit_texels == 12 && unit_notes == 13,
              "glsl/shadow/history.glsl, movement.glsl and drivers have these numbers");

namespace {

gl::TextureDesc of_mask(const gl::Texture& mask, GLenum format) {
  return {.format = format, .width = mask.width(), .height = mask.height()};
}

}  // namespace

History DenoiseContext::remembered(std::string_view name) const {
  for (const Denoiser::Remembered& texture : work_.remembered) {
    if (texture.name != name) continue;
    const History kept = history(name, of_mask(mask(), texture.format));
    return {.last = kept.last, .now = kept.now, .valid = kept.valid && frame().history};
  }
  throw std::logic_error(fmt::format("denoiser '{}' does not remember '{}'", owner_.name, name));
}

PackedMask DenoiseContext::evaluate_packed(const gl::Texture* last_surfaces) const {
  const PackedMask packed{target("texels", of_mask(mask(), GL_R32UI)), target("notes", of_mask(mask(), GL_R8UI))};
  const Technique& technique = work_.technique;
  if (technique.resolve) technique.resolve(PassContext(work_, owner_of(technique)));
  run_mask_pass(packed, last_surfaces);
  work_.frame.notes = &packed.notes;
  return packed;
}

// Runs the technique's visibility(), or packs the mask that its `resolve` filled. The latter always in a fragment
// shader.
void DenoiseContext::run_mask_pass(const PackedMask& packed, const gl::Texture* last_surfaces) const {
  const Technique& technique = work_.technique;
  const bool resolved = static_cast<bool>(technique.resolve);
  const bool compute = uses_compute() && !resolved;
  const bool history = last_surfaces != nullptr;
  gl::PassDesc desc{.name = resolved ? "pack mask" : "shadow mask"};
  if (!compute) desc.colors = {{.texture = &packed.texels}, {.texture = &packed.notes}};
  gl::Pass pass(device(), desc);
  if (resolved) {
    pass.use(work_.programs.pack(history)).set("mask_layer", frame().layer);
    bind_inputs(work_, owner_);
    device().sampler({}).bind(unit_texels);
    mask().bind(unit_texels);
  } else {
    const bool rotated = rotates_samples(technique, params(), frame().shape);
    pass.use(work_.programs.mask(technique, params(),
                                 {.rotated = rotated, .compute = compute, .packed = true, .history = history}));
    bind_inputs(work_, owner_of(technique));
  }
  if (history) bind_history(*last_surfaces);
  if (compute) {
    packed.texels.bind_image(0, GL_WRITE_ONLY);
    packed.notes.bind_image(1, GL_WRITE_ONLY);
    pass.dispatch(frame().viewport.width, frame().viewport.height);
  } else {
    pass.set_viewport(frame().viewport.x, frame().viewport.y, frame().viewport.width, frame().viewport.height);
    pass.draw_full_screen();
  }
}

void DenoiseContext::bind_history(const gl::Texture& last_surfaces) const {
  const gl::Texture* movement = frame().movement;
  for (const GLuint unit : {unit_motion, unit_last_surface, unit_movement}) device().sampler({}).bind(unit);
  gl::glBindTextureUnit(unit_motion, inputs().motion.id);
  last_surfaces.bind(unit_last_surface);
  gl::glBindTextureUnit(unit_movement, movement != nullptr ? movement->id() : 0);
}

const gl::Texture& DenoiseContext::filter(std::string_view filter, const gl::Texture& source) const {
  if (filter == "none") return source;
  // No pass to texels reads notes.
  return run_filter(work_, {.filter = work_.registry.find_filter(filter),
                            .texels = source,
                            .notes = source,
                            .context = *this,
                            .number = filters_run_++,
                            .to_mask = false});
}

void DenoiseContext::filter_to_mask(std::string_view filter, const PackedMask& source) const {
  run_filter(work_, {.filter = filter == "none" ? unfiltered() : work_.registry.find_filter(filter),
                     .texels = source.texels,
                     .notes = source.notes,
                     .context = *this,
                     .number = filters_run_++,
                     .to_mask = true});
}

}  // namespace penumbra::shadow
