#include "denoise.h"

#include <utility>

#include "filters.h"

namespace penumbra::shadow {

namespace {

LibraryProgram history_program(bool compute) {
  LibraryProgram program{.desc = {.name = "shadow history"}};
  if (compute) {
    program.desc.compute = "shadow/drivers/history.comp";
  } else {
    program.desc.vertex = "shared/full_screen.vert";
    program.desc.fragment = "shadow/drivers/history.frag";
  }
  return program;
}

gl::TextureDesc of_mask(const LibraryFrame& work, GLenum format) {
  return {.format = format, .width = work.mask().width(), .height = work.mask().height()};
}

// Of the last frame and of this one: what was seen, and what of it was lit.
struct Memory {
  History surfaces, texels;
};

const gl::Texture& blend_history(const LibraryFrame& work, const Memory& memory, const gl::Texture& texels) {
  const bool compute = work.uses_compute();
  gl::PassDesc desc{.name = "shadow history"};
  if (!compute) desc.colors = {{.texture = &memory.texels.now}, {.texture = &memory.surfaces.now}};
  gl::Pass pass(work.device(), desc);
  work.use_library(pass, history_program(compute));
  work.bind_history(memory.surfaces.last);
  for (const auto& [unit, texture] : {std::pair(unit_last_texels, &memory.texels.last), {unit_texels, &texels}}) {
    work.device().sampler({}).bind(unit);
    texture->bind(unit);
  }
  if (compute) {
    memory.texels.now.bind_image(0, GL_WRITE_ONLY);
    memory.surfaces.now.bind_image(1, GL_WRITE_ONLY);
  }
  work.cover(pass);
  return memory.texels.now;
}

}  // namespace

bool is_denoised(const ParamSet& params) {
  return params.get_bool("history.reuse") || params.get_word("filter.penumbra") != "none" ||
         params.get_word("filter.visibility") != "none";
}

const gl::Texture& draw_denoised(const LibraryFrame& work, const Registry& registry) {
  const PackedMask raw{work.target("denoise/texels", of_mask(work, GL_R32UI)),
                       work.target("denoise/notes", of_mask(work, GL_R8UI))};
  if (!work.params().get_bool("history.reuse")) {
    work.evaluate_packed(raw, /*last_surfaces=*/nullptr);
    filter_visibility(work, registry, {filter_penumbra(work, registry, raw.texels), raw.notes});
    return raw.notes;
  }
  const Memory memory{work.history("surfaces", of_mask(work, GL_RG32UI)),
                      work.history("texels", of_mask(work, GL_R32UI))};
  work.evaluate_packed(raw, &memory.surfaces.last);
  const gl::Texture& penumbrae = filter_penumbra(work, registry, raw.texels);
  const gl::Texture& blended = blend_history(work, memory, penumbrae);
  filter_visibility(work, registry, {blended, raw.notes});
  return raw.notes;
}

std::vector<LibraryProgram> denoise_programs(const Registry& registry) {
  std::vector<LibraryProgram> programs = filter_programs(registry.filters());
  for (const bool compute : {false, true}) programs.push_back(history_program(compute));
  return programs;
}

}  // namespace penumbra::shadow
