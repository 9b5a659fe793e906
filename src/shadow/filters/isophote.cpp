#include "../filter.h"

namespace penumbra::shadow {

Filter isophote() {
  return {.name = "isophote",
          .summary =
              "bilateral_separable with a third of the kernel's width, then a mean along the line of equal visibility.",
          .source = "Weickert 1999, Coherence-enhancing diffusion filtering; one step of it as a mean along a line",
          .glsl = "shadow/filters/isophote.glsl",
          .of = Filter::Of::visibility,
          .passes = 3,
          .border = {{51, 2}, {2, 51}, {51, 51}},
          .keeps = Filter::Keeps::narrow};
}

}  // namespace penumbra::shadow
