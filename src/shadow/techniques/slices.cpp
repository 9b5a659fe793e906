#include "../technique.h"

namespace penumbra::shadow {

Technique slices() {
  using enum ParamBinding;
  return {
      .name = "slices",
      .summary =
          "Integrates the light's disc along lines through the map, so that blockers at different heights add up as "
          "they should.",
      .source = "bit masks along slices as in Therrien et al. 2023, for lights: docs/techniques.md",
      .glsl = "shadow/techniques/slices.glsl",
      .needs = {"shadow_map", "least_depth_pyramid", "second_layer", "second_layer_edges"},
      .params =
          {
              // Mesa's software rasteriser ends loops after 65,535 iterations in total, and seams draw up to three
              // layers.
              {"slices.azimuths", 8, 1, 128, "slices",
               "Directions in which a pixel's light is followed: about half as many again under a narrow light, unless "
               "casters overlap.",
               compiled},
              {"slices.samples", 8, 1, 128, "texels",
               "Texels that are read along each slice: two thirds of them under a narrow light, unless casters "
               "overlap.",
               compiled},
              {"slices.narrow", 0, 0, 64, "px",
               "Where a penumbra is narrower than this in the picture, up to four times as many slices are followed, "
               "since no filter can smooth it there.",
               compiled},
              {"slices.filter_radius", 8, 0, 16, "texels",
               "Where everything that can block the light lies within so many texels, and at nearly one height, all of "
               "these texels are filtered, without slices and without noise. 0: nowhere.",
               compiled},
          },
      .decides_tiles = true,
      .tells_noise = true,
      .reads_light_discs = true};
}

}  // namespace penumbra::shadow
