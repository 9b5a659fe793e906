#include "../prefilter.h"

namespace penumbra::shadow {

// As fourier_terms, in the first half of a layer's slices; in the second half the same functions times the stored
// depth, 0 to 1. The levels hold means over squares.
Recipe cssm_terms() {
  return filtered_map(
      {.name = "cssm_terms",
       .prefix = "cssm",
       .summary =
           "Cosines and sines of depth at the frequencies of a step's Fourier series, two in each slice, then the "
           "same times the depth.",
       .source = "Annen et al. 2008, Real-time, all-frequency shadows in dynamic scenes",
       .function = "shadow/prefilter/cssm.comp",
       .format = [](const ParamSet&) { return GL_RGBA16_SNORM; },
       .slices = [](const ParamSet& params) { return (params.get_int("cssm.terms") + 1) / 2 * 2; },
       .params = {{"cssm.terms", 8, 1, 16, "", "Terms of the series, each of a cosine and a sine.",
                   ParamBinding::compiled}},
       .radius = 0});
}

}  // namespace penumbra::shadow
