#include "../technique.h"

namespace penumbra::shadow {

Technique pcss() {
  using enum ParamBinding;
  return {
      .name = "pcss",
      .summary =
          "Percentage-closer soft shadows: a blocker search gives the penumbra's width, a filter the share of light.",
      .source = "Fernando 2005, Percentage-closer soft shadows",
      .glsl = "shadow/techniques/pcss.glsl",
      .needs = needs_shadow_map | needs_depth_pyramid,
      .params = {
          {"pcss.blocker_taps", 16, 1, 256, "taps", "Points at which blockers are looked for.", compiled},
          {"pcss.filter_taps", 16, 1, 256, "taps", "Points of the penumbra's disc that are compared.", compiled},
          {"pcss.renewal_taps", 64, 1, 256, "taps", "The same where there is a history and it is refused.", compiled},
          {"pcss.early_exit", true, 0, 1, "",
           "Skips both steps where depth bounds rule blockers out; changes no result.", compiled},
      }};
}

}  // namespace penumbra::shadow
