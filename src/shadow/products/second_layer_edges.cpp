#include "../edge_pyramid.h"
#include "../recipe.h"

namespace penumbra::shadow {

Recipe second_layer_edges() {
  return {.name = "second_layer_edges",
          .summary =
              "Level n holds, for each block of 4·2^n × 4·2^n texels, where surfaces of the second layer end above "
              "something lower: the least depth, and the greatest depth of receivers to which it matters, negated.",
          .source = "docs/techniques.md, A second layer",
          .needs = {"shadow_map", "second_layer"},
          .depends_only_on_needs = true,
          .reads_light_discs = true,
          .applies = [](const ParamSet& params) { return params.get_int("maps.layers") == 2; },
          .build = build_edge_pyramid,
          .programs = [](const ParamSet&) { return edge_pyramid_programs("shadow/second_layer_edges.comp"); }};
}

}  // namespace penumbra::shadow
