#include "../technique.h"

namespace penumbra::shadow {

Technique csm_fourier() {
  return {.name = "csm_fourier",
          .summary = "Convolution shadow maps: a filter of constant radius by the Fourier series of the depth test.",
          .source = "Annen et al. 2007, Convolution shadow maps",
          .glsl = "shadow/techniques/csm_fourier.glsl",
          .needs = {"shadow_map", "fourier_terms"},
          .params = {{"csm_fourier.attenuation", 1.0f, 0, 20, "",
                      "How much the series' high terms are lowered: they ring less, and light leaks further."}},
          .soft = false};
}

}  // namespace penumbra::shadow
