#include "../technique.h"

namespace penumbra::shadow {

Technique cssm() {
  return {
      .name = "cssm",
      .summary = "Convolution soft shadow maps: the two steps of pcss, both by the Fourier series of the depth test.",
      .source = "Annen et al. 2008, Real-time, all-frequency shadows in dynamic scenes",
      .glsl = "shadow/techniques/cssm.glsl",
      .needs = {"shadow_map", "least_depth_pyramid", "cssm_terms"},
      .params = {{"cssm.attenuation", 1.0f, 0, 20, "",
                  "How much the series' high terms are lowered: they ring less, and light leaks further."}},
      .suns_only = true};
}

}  // namespace penumbra::shadow
