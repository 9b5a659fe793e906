#include "../technique.h"

namespace penumbra::shadow {

Technique pcf() {
  return {
      .name = "pcf",
      .summary = "Percentage-closer filtering over a disc of constant radius: equally soft everywhere.",
      .source = "Reeves et al. 1987, Rendering antialiased shadows with depth maps",
      .glsl = "shadow/techniques/pcf.glsl",
      .needs = {"shadow_map"},
      .params =
          {
              {"pcf.radius", 0.05f, 0, 1000, "m", "Radius of the filter's disc, which is perpendicular to the light.",
               ParamBinding::uniform},
              {"pcf.filter_taps", 16, 1, 256, "taps", "Points of the disc that are compared.", ParamBinding::compiled},
          },
      .samples = {{.name = "filter", .count_parameter = "pcf.filter_taps"}},
      .soft = false};
}

}  // namespace penumbra::shadow
