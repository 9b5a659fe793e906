#include "../edge_pyramid.h"
#include "../recipe.h"

namespace penumbra::shadow {

Recipe second_layer_edges() {
  return {.name = "second_layer_edges",
          .summary =
              "Level n holds, for each block of 4·2^n × 4·2^n texels, two values about edges of the second layer above "
              "something lower: the greatest depth of a receiver whose shadow such an edge changes, negated, and the "
              "least depth of these edges.",
          .source = "docs/techniques.md, A second layer",
          .needs = {"shadow_map", "second_layer"},
          .depends_only_on_needs = true,
          .reads_light_discs = true,
          .applies = [](const ParamSet& params) { return params.get_int("maps.layers") == 2; },
          .build = build_edge_pyramid,
          .programs =
              [](const ParamSet& params) {
                const bool is_made = params.get_int("maps.layers") == 2;
                return is_made ? edge_pyramid_programs("shadow/second_layer_edges.comp")
                               : std::vector<gl::ProgramDesc>();
              }};
}

}  // namespace penumbra::shadow
