#include "../technique.h"

namespace penumbra::shadow {

Technique esm() {
  using enum ParamBinding;
  return {
      .name = "esm",
      .summary = "Exponential shadow maps: a filter of constant radius by the mean of the exponential of depth.",
      .source = "Annen et al. 2008, Exponential shadow maps",
      .glsl = "shadow/techniques/esm.glsl",
      .needs = {"shadow_map", "esm_depths", "greatest_depth_pyramid"},
      .params = {{.name = "esm.classification",
                  .default_value = "threshold",
                  .help = "How receivers are found for which the exponential fails, because a part of the kernel's "
                          "depths lies behind them, to be filtered by comparison: by a result of more than 1, or by "
                          "the greatest depth in the kernel, which also finds those whose result a shadow keeps below "
                          "1, and some that do not fail.",
                  .binding = compiled,
                  .choices = {"none", "threshold", "greatest"}},
                 {"esm.threshold", 0.05f, 0, 10, "",
                  "By how much the result must exceed 1, or the greatest depth be able to make it exceed 1, to count "
                  "as a failure.",
                  uniform},
                 {"esm.fallback_taps", 16, 1, 256, "taps", "Points that are compared for receivers that fail.",
                  compiled}},
      .samples = {{.name = "filter", .count_parameter = "esm.fallback_taps"}},
      .soft = false};
}

}  // namespace penumbra::shadow
