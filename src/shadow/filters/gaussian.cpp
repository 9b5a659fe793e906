#include "../filter.h"

namespace penumbra::shadow {

Filter gaussian() {
  return {.name = "gaussian",
          .summary = "Gaussian mean that follows the penumbra's width; blurs across edges.",
          .source = "Deligiannis 2019, section 2.7.2",
          .glsl = "shadow/filters/gaussian.glsl",
          .of = Filter::Of::visibility,
          .passes = 2,
          .border = {{51, 2}, {2, 51}},
          .keeps = Filter::Keeps::narrow};
}

}  // namespace penumbra::shadow
