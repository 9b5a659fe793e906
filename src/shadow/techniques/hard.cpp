#include "../technique.h"

namespace penumbra::shadow {

Technique hard() {
  return {.name = "hard",
          .summary = "The shadow of the light's centre, filtered over one texel.",
          .source = "Williams 1978, Casting curved shadows on curved surfaces; Reeves et al. 1987",
          .glsl = "shadow/techniques/hard.glsl",
          .needs = {"shadow_map"},
          .params = {},
          .soft = false,
          .reads_light_discs = true};
}

}  // namespace penumbra::shadow
