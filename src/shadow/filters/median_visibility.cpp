#include "../filter.h"

namespace penumbra::shadow {

Filter median_visibility() {
  return {.name = "median_visibility",
          .summary = "Median of 3 × 3 pixels of the same surface, whatever the penumbra's width.",
          .source = "Deligiannis 2019, section 2.7.1",
          .glsl = "shadow/filters/median_visibility.glsl",
          .of = Filter::Of::visibility,
          .passes = 1,
          .border = {{1, 1}},
          .keeps = Filter::Keeps::nothing};
}

}  // namespace penumbra::shadow
