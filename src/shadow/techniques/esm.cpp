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
                  .help = "How receivers are found that lie in front of a part of the kernel's depths, for which the "
                          "exponential fails; they are filtered by comparison: by a result of more than 1, or by the "
                          "greatest depth in the kernel, which finds all of them and others beside.",
                  .binding = compiled,
                  .choices = {"none", "threshold", "greatest"}},
                 {"esm.threshold", 0.05f, 0, 10, "",
                  "A result of more than 1 by this fails, or depths that could cause it.", uniform},
                 {"esm.fallback_taps", 16, 1, 256, "taps", "Points that are compared for receivers that fail.",
                  compiled}},
      .samples = {{.name = "filter", .count_parameter = "esm.fallback_taps"}}};
}

}  // namespace penumbra::shadow
