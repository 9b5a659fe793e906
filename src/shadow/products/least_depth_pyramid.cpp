#include "../edge_pyramid.h"
#include "../recipe.h"

namespace penumbra::shadow {

Recipe least_depth_pyramid() {
  return {.name = "least_depth_pyramid",
          .summary =
              "Level n holds, for each block of 4·2^n × 4·2^n texels of the shadow map, the least depth and the least "
              "depth beside an edge.",
          .source = "Greene, Kass and Miller 1993, Hierarchical Z-buffer visibility",
          .depends_only_on_needs = true,
          .reads_light_discs = true,
          .build = build_edge_pyramid,
          .programs = [](const ParamSet&) { return edge_pyramid_programs("shadow/depth_blocks.comp"); }};
}

}  // namespace penumbra::shadow
