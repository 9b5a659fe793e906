#include "../technique.h"

namespace penumbra::shadow {

Technique vssm() {
  using enum ParamBinding;
  return {
      .name = "vssm",
      .summary =
          "Variance soft shadow maps: PCSS whose two steps read means and variances of depth from a summed-area "
          "table.",
      .source = "Yang, Dong, Feng, Seidel and Kautz 2010, Variance soft shadow mapping",
      .glsl = "shadow/techniques/vssm.glsl",
      .needs = {"shadow_map", "least_depth_pyramid", "greatest_depth_pyramid", "depth_sums"},
      .params =
          {
              {"vssm.cells", 4, 1, 8, "cells",
               "Parts along each side into which a kernel is divided where one mean and variance can't describe it.",
               compiled},
              {"vssm.taps", 2, 1, 8, "taps",
               "Points along each side of such a part that are compared where its own mean and variance can't "
               "describe it.",
               compiled},
              {"vssm.small", 2.0f, 1, 4, "texels", "Half the width of kernels of which every texel is compared.",
               compiled},
          },
      .decides_tiles = true,
      .suns_only = true};
}

}  // namespace penumbra::shadow
