#include "../technique.h"

namespace penumbra::shadow {

Technique pcf_tent() {
  return {
      .name = "pcf_tent",
      .summary = "Percentage-closer filtering with a tent of constant width in texels: smooth edges, by gathers.",
      .source = "Bunnell and Pellacini 2004, Shadow map antialiasing; Reeves et al. 1987",
      .glsl = "shadow/techniques/pcf_tent.glsl",
      .needs = {"shadow_map"},
      .params = {{"pcf_tent.width", 5, 1, 31, "texels",
                  "Width of the tent. Its gathers are (width + 2) / 2, rounded down, squared, so odd widths use them "
                  "best: 4 for 3, 9 for 5, 16 for 7.",
                  ParamBinding::compiled}},
      .soft = false};
}

}  // namespace penumbra::shadow
