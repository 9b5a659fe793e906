#include "../prefilter.h"

namespace penumbra::shadow {

// Slice i: the means of the cosine (R) and sine (G) of term 2i, and of those of term 2i + 1 (BA), each from -1 to 1
// (fourier_frequency() in glsl/lib/fourier.glsl).
Recipe fourier_terms() {
  return filtered_map(
      {.name = "fourier_terms",
       .prefix = "csm_fourier",
       .summary =
           "Cosines and sines of depth at the frequencies of a step's Fourier series, two in each slice, filtered.",
       .source = "Annen et al. 2007, Convolution shadow maps",
       .function = "shadow/prefilter/fourier.comp",
       .format = [](const ParamSet&) { return GL_RGBA8_SNORM; },
       .slices = [](const ParamSet& params) { return (params.get_int("csm_fourier.terms") + 1) / 2; },
       .params = {{"csm_fourier.terms", 16, 1, 16, "", "Terms of the series, each of a cosine and a sine.",
                   ParamBinding::compiled}}});
}

}  // namespace penumbra::shadow
