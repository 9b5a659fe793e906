#include "../prefilter.h"

namespace penumbra::shadow {

// The means of x, x², x³ and x⁴, x = 2 z - 1 and z the stored depth; in unorm16 as packed_moments() gives them
// (glsl/lib/prefilter.glsl).
Recipe msm_moments() {
  return filtered_map(
      {.name = "msm_moments",
       .prefix = "msm",
       .summary = "The first four moments of depth, filtered.",
       .source = "Peters and Klein 2015, Moment shadow mapping",
       .function = "shadow/prefilter/msm.comp",
       .format =
           [](const ParamSet& params) { return params.get_word("msm.format") == "unorm16" ? GL_RGBA16 : GL_RGBA32F; },
       .params = {{.name = "msm.format",
                   .default_value = "float32",
                   .help = "Format of a moment.",
                   .binding = ParamBinding::compiled,
                   .choices = {"float32", "unorm16"}}}});
}

}  // namespace penumbra::shadow
