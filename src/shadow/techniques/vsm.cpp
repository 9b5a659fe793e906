#include "../technique.h"

namespace penumbra::shadow {

Technique vsm() {
  return {
      .name = "vsm",
      .summary =
          "Variance shadow maps: a filter of constant radius in one fetch, by the mean and the variance of depth.",
      .source = "Donnelly and Lauritzen 2006, Variance shadow maps; Lauritzen 2007",
      .glsl = "shadow/techniques/vsm.glsl",
      .needs = {"shadow_map", "vsm_moments"},
      .params =
          {{"vsm.least_deviation", 0.01f, 0, 10, "m",
            "The depths within a kernel are taken to have at least this standard deviation, which hides rounding "
            "errors."},
           {"vsm.bleeding", 0.1f, 0, 0.99, "",
            "Visibility up to this value becomes 0: less light bleeds through shadows, but penumbrae get narrower."}},
      .soft = false};
}

}  // namespace penumbra::shadow
