#include "../prefilter.h"

namespace penumbra::shadow {

// R: the mean of z - 1/2, z the stored depth; G: that of its square.
Recipe vsm_moments() {
  return filtered_map({.name = "vsm_moments",
                       .prefix = "vsm",
                       .summary = "The first two moments of depth, filtered.",
                       .source = "Donnelly and Lauritzen 2006, Variance shadow maps",
                       .function = "shadow/prefilter/vsm.comp",
                       .format = [](const ParamSet&) { return GL_RG32F; }});
}

}  // namespace penumbra::shadow
