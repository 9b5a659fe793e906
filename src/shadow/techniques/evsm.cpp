#include "../technique.h"

namespace penumbra::shadow {

Technique evsm() {
  return {
      .name = "evsm",
      .summary =
          "Exponential variance shadow maps: variance shadow maps of depth under exponential warps, which bleed less.",
      .source = "Lauritzen and McCool 2008, Layered variance shadow maps",
      .glsl = "shadow/techniques/evsm.glsl",
      .needs = {"shadow_map", "evsm_moments"},
      .params =
          {{"evsm.plane_bias", 0.9f, 0, 10, "",
            "Bias in standard deviations of a plane's depth under the kernel: at 1.8 slopes hardly shadow "
            "themselves, less keeps contacts darker."},
           {"evsm.least_deviation", 0.01f, 0, 10, "m",
            "The depths within a kernel are taken to have at least this standard deviation, which hides rounding "
            "errors."},
           {"evsm.bleeding", 0.0f, 0, 0.99, "",
            "Visibility up to this value becomes 0: less light bleeds through shadows, but penumbrae get narrower."}},
      .soft = false};
}

}  // namespace penumbra::shadow
