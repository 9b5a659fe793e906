#include "../technique.h"

namespace penumbra::shadow {

Technique pcf_hardware() {
  return {.name = "pcf_hardware",
          .summary = "The shadow of the light's centre by one fetch of the GPU's comparing sampler: its 2 x 2 filter.",
          .source =
              "Reeves et al. 1987, Rendering antialiased shadows with depth maps; Bunnell and Pellacini 2004, "
              "Shadow map antialiasing",
          .glsl = "shadow/techniques/pcf_hardware.glsl",
          .needs = {"shadow_map", "compared_depth"},
          .params = {},
          .soft = false,
          .reads_light_discs = true};
}

}  // namespace penumbra::shadow
