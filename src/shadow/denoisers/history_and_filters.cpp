#include <utility>

#include "../denoise_context.h"
#include "../denoiser.h"

namespace penumbra::shadow {

namespace {

std::vector<Param> rows() {
  return {
      {"history.reuse", false, 0, 1, "", "Blends each frame with the last ones where they show the same surface."},
      {"history.alpha", 0.1f, 0.01, 1, "", "Weight of the present frame in the blend."},
      {"history.mean", false, 0, 1, "",
       "Averages all frames equally until a new one would weigh less than history.alpha or 1/31, and narrows "
       "filter.visibility as frames add up."},
      {"history.distance", 1.0f, 0, 100, "px",
       "How far before or behind a receiver's plane, in widths of a pixel, the last frame's surface may lie."},
      {"history.turn", 30.0f, 0, 180, "deg",
       "Largest angle between a receiver's normal and that of the last frame's surface."},
  };
}

// The textures that are kept for the next frame: the visible surfaces, and their visibility.
struct Memory {
  History surfaces, texels;
};

const gl::Texture& blend(const DenoiseContext& context, const Memory& memory, const gl::Texture& texels) {
  const bool compute = context.uses_compute();
  gl::PassDesc desc{.name = "shadow history"};
  if (!compute) desc.colors = {{.texture = &memory.texels.now}, {.texture = &memory.surfaces.now}};
  gl::Pass pass(context.device(), desc);
  context.use(pass, compute ? "blend in compute" : "blend");
  context.bind_history(memory.surfaces.last);
  for (const auto& [unit, texture] : {std::pair(unit_last_texels, &memory.texels.last), {unit_texels, &texels}}) {
    context.device().sampler({}).bind(unit);
    texture->bind(unit);
  }
  if (compute) {
    memory.texels.now.bind_image(0, GL_WRITE_ONLY);
    memory.surfaces.now.bind_image(1, GL_WRITE_ONLY);
  }
  context.cover(pass);
  return memory.texels.now;
}

// The history is stored before the visibility filter, so that blur does not accumulate from frame to frame.
void denoise(const DenoiseContext& context) {
  const std::string& penumbra_filter = context.params().get_word("filter.penumbra");
  const std::string& visibility_filter = context.params().get_word("filter.visibility");
  if (!context.params().get_bool("history.reuse")) {
    const PackedMask raw = context.evaluate_packed();
    const gl::Texture& penumbrae = context.filter(penumbra_filter, raw);
    context.filter_to_mask(visibility_filter, {penumbrae, raw.notes, raw.distances});
    return;
  }
  const Memory memory{context.remembered("surfaces"), context.remembered("texels")};
  const PackedMask raw = context.evaluate_packed(&memory.surfaces.last);
  const gl::Texture& penumbrae = context.filter(penumbra_filter, raw);
  const gl::Texture& blended = blend(context, memory, penumbrae);
  context.filter_to_mask(visibility_filter, {blended, raw.notes, raw.distances});
}

}  // namespace

Denoiser history_and_filters() {
  return {.name = "history_and_filters",
          .summary = "A filter of the blocker distances, a blend with the last frames, a filter of the visibility.",
          .source = "Deligiannis 2019, section 3.5",
          .needs = {"movement_map"},
          .params = rows(),
          .applies =
              [](const ParamSet& params) {
                return params.get_bool("history.reuse") || params.get_word("filter.penumbra") != "none" ||
                       params.get_word("filter.visibility") != "none";
              },
          .remembers =
              [](const ParamSet& params) {
                if (!params.get_bool("history.reuse")) return std::vector<Denoiser::Remembered>{};
                return std::vector<Denoiser::Remembered>{{"surfaces", GL_RG32UI}, {"texels", packed_format}};
              },
          .denoise = denoise,
          .programs =
              [](const ParamSet&) {
                return std::vector<gl::ProgramDesc>{
                    {.name = "blend", .vertex = "shared/full_screen.vert", .fragment = "shadow/drivers/history.frag"},
                    {.name = "blend in compute", .compute = "shadow/drivers/history.comp"}};
              }};
}

}  // namespace penumbra::shadow
