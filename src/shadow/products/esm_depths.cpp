#include "../prefilter.h"

namespace penumbra::shadow {

// R: the logarithm of the mean of exp(c z), divided by c, z a depth from 0 to 1 (filtered_of_stored() in
// shadow/projection).
Recipe esm_depths() {
  return filtered_map({.name = "esm_depths",
                       .prefix = "esm",
                       .summary = "Logarithms of the filtered exponentials of depth, over their exponent.",
                       .source = "Annen et al. 2008, Exponential shadow maps; Salvi 2008",
                       .function = "shadow/prefilter/esm.comp",
                       .format = [](const ParamSet&) { return GL_R32F; },
                       .params = {{"esm.exponent", 80.0f, 1, 10000, "",
                                   "Factor of a layer's depth, 0 to 1, in the exponential: the greater, the less light "
                                   "leaks, and the more receivers fail.",
                                   ParamBinding::uniform}},
                       .log_space = true});
}

}  // namespace penumbra::shadow
