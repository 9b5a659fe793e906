#include "../filter.h"

namespace penumbra::shadow {

Filter bilateral_separable() {
  return {.name = "bilateral_separable",
          .summary = "Gaussian mean, weighted by distance from the receiver's plane, along x and then along y.",
          .source = "Pham and van Vliet 2005, Separable bilateral filtering for fast video preprocessing",
          .glsl = "shadow/filters/bilateral_separable.glsl",
          .of = Filter::Of::visibility,
          .passes = 2,
          .border = {{51, 2}, {2, 51}},
          .keeps = Filter::Keeps::narrow};
}

}  // namespace penumbra::shadow
