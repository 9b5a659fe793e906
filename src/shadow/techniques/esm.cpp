#include "../technique.h"

namespace penumbra::shadow {

Technique esm() {
  using enum ParamBinding;
  return {.name = "esm",
          .summary = "Exponential shadow maps: a filter of constant radius by the mean of the exponential of depth.",
          .source = "Annen et al. 2008, Exponential shadow maps",
          .glsl = "shadow/techniques/esm.glsl",
          .needs = {"shadow_map", "esm_depths", "greatest_depth_pyramid"},
          .params = {{.name = "esm.classification",
                      .default_value = "threshold",
                      .help = "How receivers are found for which the exponential fails, so that depths are compared "
                              "for them instead: by a result above 1 (threshold), by the greatest depth in the kernel, "
                              "which finds more of them and some that do not fail (greatest), or not at all (none).",
                      .binding = compiled,
                      .choices = {"none", "threshold", "greatest"}},
                     {"esm.threshold", 0.05f, 0, 10, "",
                      "How far above 1 the result must be, or with greatest could be, to count as a failure.", uniform},
                     {"esm.fallback_taps", 16, 1, 256, "taps", "Points that are compared for receivers that fail.",
                      compiled}},
          .samples = {{.name = "filter", .count_parameter = "esm.fallback_taps"}},
          .soft = false};
}

}  // namespace penumbra::shadow
