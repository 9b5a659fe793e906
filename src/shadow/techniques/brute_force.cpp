#include "../technique.h"

namespace penumbra::shadow {

Technique brute_force() {
  using enum ParamBinding;
  return {
      .name = "brute_force",
      .summary = "PCSS with hundreds of taps a pixel: the result that forms with fewer taps converge to.",
      .source = "Deligiannis 2019, chapter 4",
      .glsl = "shadow/techniques/brute_force.glsl",
      .needs = {"shadow_map", "least_depth_pyramid"},
      .params =
          {
              {"brute_force.blocker_taps", 256, 1, 256, "taps", "Points that the blocker search reads.", compiled},
              {"brute_force.filter_taps", 256, 1, 256, "taps", "Points of the penumbra's disc that are compared.",
               compiled},
              {"brute_force.every_texel", false, 0, 1, "",
               "Reads every texel of both discs instead: exact, and slow for wide kernels.", compiled},
          },
      .samples = {{.name = "blocker", .count_parameter = "brute_force.blocker_taps", .step = SampleSet::Step::blocker},
                  {.name = "filter", .count_parameter = "brute_force.filter_taps"},
                  {.name = "disocclusion", .count_parameter = "brute_force.filter_taps"}},
      .pattern = "hammersley",
      .scramble = "shift",
      .reads_light_discs = true};
}

}  // namespace penumbra::shadow
