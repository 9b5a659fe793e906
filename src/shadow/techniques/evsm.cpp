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
      .params = {{"evsm.plane_bias", 0.9f, 0, 10, "",
                  "Bias in standard deviations of a plane's depth under the kernel: at 1.8 slopes hardly shadow "
                  "themselves, less keeps contacts darker."},
                 {"evsm.least_deviation", 0.01f, 0, 10, "m",
                  "Least standard deviation of the depth within a kernel: hides what the moments' rounding leaves."},
                 {"evsm.bleeding", 0.0f, 0, 0.99, "",
                  "What is darker than this becomes black: less light bleeds through, and penumbrae narrow."}},
      .soft = false};
}

}  // namespace penumbra::shadow
