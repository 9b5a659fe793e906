#include "../pass_context.h"
#include "../recipe.h"

namespace penumbra::shadow {

Recipe compared_depth() {
  return {.name = "compared_depth",
          .summary =
              "The shadow map itself, read by a sampler that compares: a fetch gives the share of four texels that are "
              "not nearer to the light than a depth.",
          .source = "Reeves et al. 1987; comparing samplers of OpenGL 4.5",
          .sampler = {.min_filter = GL_LINEAR,
                      .mag_filter = GL_LINEAR,
                      .wrap_s = GL_CLAMP_TO_BORDER,
                      .wrap_t = GL_CLAMP_TO_BORDER,
                      .compare = true},
          .reads_light_discs = true,
          .build = [](const PassContext& context) -> const gl::Texture& { return context.shadow_map(); }};
}

}  // namespace penumbra::shadow
