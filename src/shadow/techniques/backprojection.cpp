#include "../technique.h"

namespace penumbra::shadow {

Technique backprojection() {
  using enum ParamBinding;
  return {
      .name = "backprojection",
      .summary =
          "Projects the map's texels from the receiver onto the light, where bit masks gather which of its points "
          "they hide.",
      .source =
          "Guennebaud et al. 2006, Real-time soft shadow mapping by backprojection; Schwarz and Stamminger "
          "2007, Bitmask soft shadows",
      .glsl = "shadow/techniques/backprojection.glsl",
      .needs = {"shadow_map", "least_depth_pyramid"},
      .params =
          {
              // Mesa's software rasteriser ends loops after 65,535 iterations in total, and a seam draws two layers.
              {"backprojection.reads", 9, 3, 29, "reads",
               "Gathers of four texels along each side of the area that can hide a part of the light, at most. Even "
               "numbers count as the next odd one.",
               compiled},
              {"backprojection.masks", 8, 1, 8, "masks", "Bit masks, each of 32 points of the square around the light.",
               compiled},
          },
      .decides_tiles = true,
      .suns_only = true,
      .reads_light_discs = true};
}

}  // namespace penumbra::shadow
