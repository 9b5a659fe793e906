#include "../technique.h"

namespace penumbra::shadow {

Technique msm() {
  return {
      .name = "msm",
      .summary = "Moment shadow maps: a filter of constant radius in one fetch, by four moments of depth.",
      .source = "Peters and Klein 2015, Moment shadow mapping",
      .glsl = "shadow/techniques/msm.glsl",
      .needs = {"shadow_map", "msm_moments"},
      .params =
          {{"msm.plane_bias", 0.9f, 0, 10, "",
            "Bias in standard deviations of a plane's depth under the kernel: at 1.8 no slope shadows itself, "
            "less keeps contacts darker."},
           {"msm.moment_bias", 3e-6f, 0, 0.1, "",
            "Share of evenly spread depths that is mixed into the moments, against their rounding; at least "
            "0.00006 in unorm16."},
           {"msm.bleeding", 0.0f, 0, 0.99, "",
            "Visibility up to this value becomes 0: less light bleeds through shadows, but penumbrae get narrower."}},
      .soft = false};
}

}  // namespace penumbra::shadow
