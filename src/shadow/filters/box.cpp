#include "../filter.h"

namespace penumbra::shadow {

Filter box() {
  return {.name = "box",
          .summary = "Mean over a rectangle that follows the penumbra's width; blurs across edges.",
          .source = "Deligiannis 2019, section 2.7.1",
          .glsl = "shadow/filters/box.glsl",
          .of = Filter::Of::visibility,
          .passes = 2,
          .border = {{45, 2}, {2, 45}},
          .keeps = Filter::Keeps::narrow};
}

}  // namespace penumbra::shadow
