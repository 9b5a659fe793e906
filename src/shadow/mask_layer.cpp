#include "mask_layer.h"

#include <fmt/format.h>

#include <optional>

#include "denoise_context.h"
#include "mask_pass.h"
#include "tiles.h"
#include "uploads.h"

namespace penumbra::shadow {

namespace {

void draw_all_pixels(const LightWork& work) {
  const PassContext context(work, owner_of(work.technique));
  if (work.denoiser != nullptr) {
    work.denoiser->denoise(DenoiseContext(work, owner_of(*work.denoiser)));
  } else if (work.technique.resolve) {
    work.technique.resolve(context);
  } else {
    context.evaluate(work.mask, work.frame.layer);
  }
}

std::string scaled_prefix(const ViewState& view, int scale) { return fmt::format("{}scale {}/", view.prefix, scale); }

// Runs the technique and the denoiser for every scale-th pixel, and fills the light's layer of the mask from these.
void draw_some_pixels(int scale, LightWork work, ScaledViews& views) {
  const std::string prefix = scaled_prefix(work.view, scale);
  if (!views.contains(scale)) views.emplace(scale, scaled_inputs(work, prefix, scale));
  const ScaledInputs& scaled = views.at(scale);
  gl::TextureDesc desc = work.mask.desc();
  desc.width = scaled.inputs.depth.width;
  desc.height = scaled.inputs.depth.height;
  LightFrame frame = work.frame;
  frame.viewport = viewport_of(scaled.inputs);
  frame.scale = scale;
  std::optional<Tiles> tiles, of_scaled;
  if (decides_tiles(work)) work.tiles = &tiles.emplace(fill_decided_tiles(work));
  LightWork small{.device = work.device,
                  .registry = work.registry,
                  .programs = work.programs,
                  .samples = work.samples,
                  .inputs = scaled.inputs,
                  .light = work.light,
                  .mask = work.device.target(prefix + "mask", desc),
                  .view = work.view,
                  .state = work.state,
                  .frame = frame,
                  .technique = work.technique,
                  .forward = work.forward,
                  .denoiser = work.denoiser,
                  .remembered = work.remembered};
  if (tiles && decides_tiles(small))
    small.tiles = &of_scaled.emplace(
        scaled_tiles(small, {.tiles = *tiles, .viewport = work.frame.viewport, .has_faces = has_faces(work)}));
  const gl::Buffer* of_view = work.state.shadow_block;
  upload_light(small, "scaled light", scaled.ndc * work.view.last_jitter, scale);
  draw_all_pixels(small);
  work.state.shadow_block = of_view;
  work.frame.notes = frame.notes;
  upsample(work, {small.mask, scaled.inputs.depth.id}, scale);
  work.frame.scale = scale;
}

}  // namespace

void draw_layer(const LightWork& work, ScaledViews& views) {
  const int scale = mask_scale(work.technique, work.params(), work.mask);
  if (scale == 1) {
    draw_all_pixels(work);
  } else {
    draw_some_pixels(scale, work, views);
  }
}

void release_scales(gl::Device& device, const ViewState& view, const ScaledViews& used) {
  constexpr int most = 4;
  for (int scale = 2; scale <= most; ++scale) {
    if (!used.contains(scale)) device.drop(scaled_prefix(view, scale));
  }
}

}  // namespace penumbra::shadow
