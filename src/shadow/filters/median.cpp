#include "../filter.h"

namespace penumbra::shadow {

Filter median() {
  return {.name = "median",
          .summary = "Median of the blocker distances of 3 × 3 pixels.",
          .source = "Tukey 1977, Exploratory data analysis, chapter 7",
          .glsl = "shadow/filters/median.glsl",
          .of = Filter::Of::penumbra,
          .passes = 1,
          .border = {{1, 1}},
          .keeps = Filter::Keeps::unblocked};
}

}  // namespace penumbra::shadow
