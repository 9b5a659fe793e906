#include "../technique.h"

namespace penumbra::shadow {

Technique pcf_poisson() {
  return {.name = "pcf_poisson",
          .summary =
              "Percentage-closer filtering at the points of a Poisson disc, rotated from pixel to pixel, by the GPU's "
              "comparing sampler.",
          .source =
              "Reeves et al. 1987, Rendering antialiased shadows with depth maps; Cook 1986, Stochastic sampling in "
              "computer graphics",
          .glsl = "shadow/techniques/pcf_poisson.glsl",
          .needs = {"shadow_map", "compared_depth"},
          .params =
              {
                  {"pcf_poisson.radius", 0.05f, 0, 1000, "m",
                   "Radius of the filter's disc, which is perpendicular to the light.", ParamBinding::uniform},
                  {"pcf_poisson.taps", 16, 1, 256, "taps", "Points of the disc, each of which costs one fetch.",
                   ParamBinding::compiled},
              },
          .samples = {{.name = "filter", .count_parameter = "pcf_poisson.taps"}},
          .pattern = "poisson",
          .scramble = "rotate",
          .soft = false};
}

}  // namespace penumbra::shadow
