#include "../technique.h"

namespace penumbra::shadow {

Technique pcss() {
  using enum ParamBinding;
  return {
      .name = "pcss",
      .summary =
          "Percentage-closer soft shadows: a blocker search finds the penumbra's width, then a filter of "
          "that width the share of light.",
      .source = "Fernando 2005, Percentage-closer soft shadows",
      .glsl = "shadow/techniques/pcss.glsl",
      .needs = {"shadow_map", "least_depth_pyramid"},
      .params =
          {
              {"pcss.blocker_taps", 16, 1, 256, "taps", "Points that the blocker search reads.", compiled},
              {.name = "pcss.blocker_reads",
               .default_value = "footprint",
               .help = "What the blocker search reads at a point: the four texels around it, or, for a quarter of the "
                       "cost and with more noise, the texel there.",
               .binding = compiled,
               .choices = {"footprint", "texel"}},
              {"pcss.filter_taps", 16, 1, 256, "taps", "Points of the penumbra's disc that are compared.", compiled},
              {.name = "pcss.disocclusion_taps",
               .default_value = 64,
               .min = 1,
               .max = 256,
               .unit = "taps",
               .help = "Used instead of pcss.filter_taps where the history is refused, as after a disocclusion.",
               .binding = compiled,
               .former_names = {"pcss.renewal_taps"}},
              {"pcss.early_exit", true, 0, 1, "",
               "Skips both steps where the least depths of the map rule out blockers; changes no result.", compiled},
          },
      .samples = {{.name = "blocker", .count_parameter = "pcss.blocker_taps", .step = SampleSet::Step::blocker},
                  {.name = "filter", .count_parameter = "pcss.filter_taps"},
                  {.name = "disocclusion", .count_parameter = "pcss.disocclusion_taps"}},
      .decides_tiles = true,
      .reads_light_discs = true};
}

}  // namespace penumbra::shadow
