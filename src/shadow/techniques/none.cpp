#include "../technique.h"

namespace penumbra::shadow {

Technique none() {
  return {.name = "none",
          .summary = "No shadows: everything that faces the sun is lit.",
          .source = "",
          .glsl = "shadow/techniques/none.glsl",
          .needs = {},
          .params = {},
          .soft = false,
          .reads_light_discs = true};
}

}  // namespace penumbra::shadow
