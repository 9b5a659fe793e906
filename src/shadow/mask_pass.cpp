#include "mask_pass.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "light_work.h"
#include "tiles.h"

namespace penumbra::shadow {

namespace {

gl::PassDesc pass_of(const char* name, const MaskOutput& output) {
  if (output.packed == nullptr) return {.name = name, .colors = {{.texture = output.mask, .layer = output.layer}}};
  return {.name = name, .colors = {{.texture = &output.packed->texels}, {.texture = &output.packed->notes}}};
}

void set_viewport(gl::Pass& pass, const Rect& viewport) {
  pass.set_viewport(viewport.x, viewport.y, viewport.width, viewport.height);
}

const gl::Program& use(gl::Pass& pass, const LightWork& work, const gl::ProgramDesc& desc, const MaskOutput& output) {
  const gl::Program& program = pass.use(desc);
  bind_inputs(work, owner_of(work.technique));
  if (output.last_surfaces != nullptr) bind_history(work, *output.last_surfaces);
  return program;
}

void bind_images(const gl::Program& program, const MaskOutput& output) {
  if (output.packed != nullptr) {
    output.packed->texels.bind_image(0, GL_WRITE_ONLY);
    output.packed->notes.bind_image(1, GL_WRITE_ONLY);
  } else {
    program.set("mask_layer", output.layer);
    output.mask->bind_image(0, GL_WRITE_ONLY);
  }
}

// The parts of the viewport that passes of their own draw. Where a program does something before each pass (see
// gl::Device::before_pass), it must not wait for the whole mask; else there is one, without a scissor.
std::vector<std::optional<gl::TexelRect>> bands_of(const LightWork& work) {
  if (!work.device.before_pass) return {std::nullopt};
  constexpr int pixels = 1 << 18;  // about 30 ms on a software rasteriser
  const Rect& all = work.frame.viewport;
  const int height = std::max(pixels / all.width / Tiles::size, 1) * Tiles::size;
  std::vector<std::optional<gl::TexelRect>> bands;
  for (int y = 0; y < all.height; y += height) {
    bands.emplace_back(
        gl::TexelRect{.x = all.x, .y = all.y + y, .width = all.width, .height = std::min(height, all.height - y)});
  }
  return bands;
}

gl::PassDesc pass_of(const MaskOutput& output, const std::optional<gl::TexelRect>& band) {
  gl::PassDesc desc = pass_of("shadow mask", output);
  desc.scissor = band;
  return desc;
}

Programs::MaskForm form_of(const LightWork& work, const MaskOutput& output) {
  return {.compiled = Programs::compiled_for(work.technique, work.params(), work.frame.shape),
          .compute = work.params().get_word("driver") == "compute",
          .scaled = work.frame.scale > 1 && work.technique.decides_tiles &&
                    (output.packed != nullptr || output.mask == &work.mask),
          .packed = output.packed != nullptr,
          .history = output.last_surfaces != nullptr};
}

void compute_all(const LightWork& work, const MaskOutput& output) {
  Programs::MaskForm form = form_of(work, output);
  form.reads_all = lists_apart(work);
  const gl::ProgramDesc mask = work.programs.mask(work.technique, work.params(), form);
  const Rect& viewport = work.frame.viewport;
  if (form.compute) {
    gl::Pass pass(work.device, {.name = "shadow mask"});
    bind_images(use(pass, work, mask, output), output);
    pass.dispatch(viewport.width, viewport.height);
    return;
  }
  for (const std::optional<gl::TexelRect>& band : bands_of(work)) {
    gl::Pass pass(work.device, pass_of(output, band));
    use(pass, work, mask, output);
    set_viewport(pass, viewport);
    pass.draw_full_screen();
  }
}

void fill_decided(const LightWork& work, const MaskOutput& output, const Tiles& tiles, gl::Pass& pass) {
  set_viewport(pass, work.frame.viewport);
  Programs::MaskForm form = form_of(work, output);
  const gl::Texture& mask = output.packed != nullptr ? work.mask : *output.mask;
  form.details = mask.desc().format != GL_R16F || (form.packed && work.frame.shape.lamp);
  use(pass, work, work.programs.decided(form), output).set("noise_free", work.technique.tells_noise ? 1 : 0);
  work.device.sampler({}).bind(unit_decisions);
  tiles.decisions.bind(unit_decisions);
  draw_tiles(pass, tiles.list, decided_draw_offset);
}

// The listed tiles, or those of them that are listed apart.
void compute_list(const LightWork& work, const MaskOutput& output, const Tiles& tiles, Programs::MaskForm form,
                  gl::Pass& pass) {
  const gl::Program& program = use(pass, work, work.programs.mask(work.technique, work.params(), form), output);
  if (form.compute) {
    bind_images(program, output);
    tiles.list.bind_storage(tile_list_binding);
    pass.dispatch_indirect(tiles.list, form.reads_all ? apart_dispatch_offset : listed_dispatch_offset);
  } else {
    draw_tiles(pass, tiles.list, form.reads_all ? apart_draw_offset : listed_draw_offset);
  }
}

void compute_listed(const LightWork& work, const MaskOutput& output, const Tiles& tiles, gl::Pass& pass) {
  Programs::MaskForm form = form_of(work, output);
  form.tiles = true;
  compute_list(work, output, tiles, form, pass);
  if (!lists_apart(work)) return;
  form.reads_all = true;
  compute_list(work, output, tiles, form, pass);
}

}  // namespace

bool has_faces(const LightWork& work) { return work.frame.shape.lamp && work.frame.projection.layers() > 1; }

bool lists_apart(const LightWork& work) {
  return work.frame.shape.lamp || reads_second_layer(work.technique, work.params());
}

const gl::Texture* run_mask_pass(const LightWork& work, const MaskOutput& output) {
  if (!decides_tiles(work)) {
    compute_all(work, output);
    return nullptr;
  }
  const Tiles tiles = work.tiles != nullptr ? *work.tiles : decide_tiles(work);
  if (form_of(work, output).compute) {
    {
      gl::Pass pass(work.device, pass_of("decided tiles", output));
      fill_decided(work, output, tiles, pass);
      pass.barrier();  // the next pass writes the same texture as an image
    }
    gl::Pass pass(work.device, {.name = "shadow mask"});
    compute_listed(work, output, tiles, pass);
  } else {
    for (const std::optional<gl::TexelRect>& band : bands_of(work)) {
      gl::Pass pass(work.device, pass_of(output, band));
      fill_decided(work, output, tiles, pass);
      compute_listed(work, output, tiles, pass);
    }
  }
  return &tiles.decisions;
}

Tiles fill_decided_tiles(const LightWork& work) {
  const Tiles tiles = decide_all_tiles(work);
  const MaskOutput output{.mask = &work.mask, .layer = work.frame.layer};
  gl::Pass pass(work.device, pass_of("decided tiles", output));
  fill_decided(work, output, tiles, pass);
  pass.barrier();  // compute shaders write the same texture as an image
  return tiles;
}

void run_for_pixels(const LightWork& work, const gl::Buffer& list) {
  const Programs::MaskForm form{.compiled = Programs::compiled_for(work.technique, work.params(), work.frame.shape),
                                .compute = true,
                                .listed_pixels = true,
                                .reads_all = lists_apart(work)};
  const MaskOutput output{.mask = &work.mask, .layer = work.frame.layer};
  gl::Pass pass(work.device, {.name = "missing pixels"});
  const gl::Program& program = use(pass, work, work.programs.mask(work.technique, work.params(), form), output);
  bind_images(program, output);
  program.set("lists_noisy", listed_pixels(work) == ListedPixels::filtered ? 1 : 0);
  list.bind_storage(tile_list_binding);
  pass.dispatch_indirect(list, pixels_dispatch_offset);
}

void bind_history(const LightWork& work, const gl::Texture& last_surfaces) {
  const gl::Texture* movement = work.frame.movement;
  for (const GLuint unit : {unit_motion, unit_last_surface}) work.device.sampler({}).bind(unit);
  work.device.sampler({.min_filter = GL_NEAREST_MIPMAP_NEAREST}).bind(unit_movement);
  gl::glBindTextureUnit(unit_motion, work.inputs.motion.id);
  last_surfaces.bind(unit_last_surface);
  gl::glBindTextureUnit(unit_movement, movement != nullptr ? movement->id() : 0);
}

}  // namespace penumbra::shadow
