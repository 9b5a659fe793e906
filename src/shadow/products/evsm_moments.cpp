#include "../prefilter.h"

namespace penumbra::shadow {

// RG: the means of the warp that grows towards far depths and of its square; BA, with two warps: those of the other one
// (exponential_warp() in glsl/lib/prefilter.glsl, of 2 z - 1, z the stored depth).
Recipe evsm_moments() {
  using enum ParamBinding;
  return filtered_map(
      {.name = "evsm_moments",
       .prefix = "evsm",
       .summary = "The first two moments of one or two exponential warps of depth, filtered.",
       .source = "Lauritzen and McCool 2008, Layered variance shadow maps",
       .function = "shadow/prefilter/evsm.comp",
       .format =
           [](const ParamSet& params) {
             const bool half = params.get_word("evsm.format") == "float16";
             if (params.get_int("evsm.warps") == 1) return half ? GL_RG16F : GL_RG32F;
             return half ? GL_RGBA16F : GL_RGBA32F;
           },
       .params = {
           {"evsm.warps", 2, 1, 2, "",
            "Warps of depth, with two moments each: 1 takes only the one that grows towards far depths.", compiled},
           {.name = "evsm.format",
            .default_value = "float32",
            .help = "Format of a moment.",
            .binding = compiled,
            .choices = {"float32", "float16"}},
           {"evsm.positive", 40.0f, 0, 42, "",
            "Exponent of the warp that grows towards far depths; at most 5.54 in float16.", uniform},
           {"evsm.negative", 8.0f, 0, 42, "",
            "Exponent of the warp that grows towards near depths; at most 5.54 in float16.", uniform}}});
}

}  // namespace penumbra::shadow
