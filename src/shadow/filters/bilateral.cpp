#include "../filter.h"

namespace penumbra::shadow {

Filter bilateral() {
  return {
      .name = "bilateral",
      .summary = "Gaussian mean, weighted by distance from the receiver's plane, over the whole kernel: the reference.",
      .source = "Tomasi and Manduchi 1998, Bilateral filtering for gray and color images",
      .glsl = "shadow/filters/bilateral.glsl",
      .of = Filter::Of::visibility,
      .passes = 1,
      .border = {{51, 51}},
      .keeps = Filter::Keeps::narrow};
}

}  // namespace penumbra::shadow
