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
      .params = {{"vsm.least_deviation", 0.01f, 0, 10, "m",
                  "Least standard deviation of the depth within a kernel: hides what the moments' rounding leaves."},
                 {"vsm.bleeding", 0.1f, 0, 0.99, "",
                  "What is darker than this becomes black: less light bleeds through, and penumbrae narrow."}},
      .soft = false};
}

}  // namespace penumbra::shadow
