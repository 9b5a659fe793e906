#include "denoise_context.h"

#include <fmt/format.h>

#include <stdexcept>

#include "filters.h"
#include "light_work.h"
#include "mask_pass.h"
#include "tiles.h"

namespace penumbra::shadow {

static_assert(unit_motion == 8 && unit_last_surface == 9 && unit_movement == 10 && unit_last_texels == 11 &&
                  unit_texels == 12 && unit_notes == 13 && unit_decisions == 14,
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
  PackedMask packed{target("texels", of_mask(mask(), packed_format)), target("notes", of_mask(mask(), GL_R8UI))};
  const Technique& technique = work_.technique;
  if (technique.resolve) {
    technique.resolve(PassContext(work_, owner_of(technique)));
    pack(packed, last_surfaces);
  } else {
    packed.distances.decisions = run_mask_pass(work_, {.packed = &packed, .last_surfaces = last_surfaces});
  }
  packed.distances.texels = &packed.texels;
  work_.frame.notes = &packed.notes;
  return packed;
}

// Packs the mask that the technique's `resolve` filled, always in a fragment shader.
void DenoiseContext::pack(const PackedMask& packed, const gl::Texture* last_surfaces) const {
  gl::Pass pass(device(), {.name = "pack mask", .colors = {{.texture = &packed.texels}, {.texture = &packed.notes}}});
  pass.use(work_.programs.pack(last_surfaces != nullptr)).set("mask_layer", frame().layer);
  bind_inputs(work_, owner_);
  device().sampler({}).bind(unit_texels);
  mask().bind(unit_texels);
  if (last_surfaces != nullptr) bind_history(*last_surfaces);
  pass.set_viewport(frame().viewport.x, frame().viewport.y, frame().viewport.width, frame().viewport.height);
  pass.draw_full_screen();
}

void DenoiseContext::bind_history(const gl::Texture& last_surfaces) const {
  shadow::bind_history(work_, last_surfaces);
}

const gl::Buffer& DenoiseContext::changing_tiles(const BlockerDistances& distances, Filter::Keeps keeps) const {
  for (const Listed& listed : listed_) {
    if (listed.distances == distances.texels && listed.keeps == keeps) return *listed.tiles;
  }
  // A list of the same kind is in the same buffer.
  std::erase_if(listed_, [&](const Listed& listed) { return listed.keeps == keeps; });
  return *listed_.emplace_back(distances.texels, keeps, &list_filter_tiles(work_, distances, keeps)).tiles;
}

const gl::Texture& DenoiseContext::run(const Filter& filter, const PackedMask& source, bool to_mask) const {
  if (source.texels.desc().format != packed_format)
    throw std::logic_error(
        fmt::format("denoiser '{}' filters texels that lack depths: see packed_format", owner_.name));
  const bool spares = source.distances.texels != nullptr && fits_tiles(work_) && !filters_all_pixels(work_, filter);
  return run_filter(work_, {.filter = filter,
                            .texels = source.texels,
                            .notes = source.notes,
                            .context = *this,
                            .tiles = spares ? &changing_tiles(source.distances, filter.keeps) : nullptr,
                            .number = filters_run_++,
                            .to_mask = to_mask});
}

const gl::Texture& DenoiseContext::filter(std::string_view filter, const PackedMask& source) const {
  return filter == "none" ? source.texels : run(work_.registry.find_filter(filter), source, /*to_mask=*/false);
}

void DenoiseContext::filter_to_mask(std::string_view filter, const PackedMask& source) const {
  run(filter == "none" ? unfiltered() : work_.registry.find_filter(filter), source, /*to_mask=*/true);
}

}  // namespace penumbra::shadow
