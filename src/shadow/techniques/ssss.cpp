#include <vector>

#include "../pass_context.h"
#include "../technique.h"

namespace penumbra::shadow {

namespace {

// The hard shadow goes to a texture of its own, because each pixel of the mask is a mean of many of its pixels.
void soften(const PassContext& context) {
  const gl::Texture& hard = context.target("hard shadow", {.target = GL_TEXTURE_2D_ARRAY,
                                                           .format = GL_RGBA16F,
                                                           .width = context.mask().width(),
                                                           .height = context.mask().height()});
  context.evaluate(hard, 0);
  const bool compute = context.uses_compute();
  gl::PassDesc desc{.name = "screen-space blur"};
  if (!compute) desc.colors = {{.texture = &context.mask(), .layer = context.frame().layer}};
  gl::Pass pass(context.device(), desc);
  const gl::Program& program = context.use(pass, compute ? "soften in compute" : "soften");
  context.device().sampler({}).bind(first_pass_unit);
  hard.bind(first_pass_unit);
  if (compute) {
    program.set("mask_layer", context.frame().layer);
    context.mask().bind_image(0, GL_WRITE_ONLY);
  }
  context.cover(pass);
}

}  // namespace

Technique ssss() {
  using enum ParamBinding;
  return {
      .name = "ssss",
      .summary =
          "Screen-space soft shadows: the hard shadow is blurred in the picture, by a kernel that follows the "
          "blockers' distance and stops at edges.",
      .source =
          "MohammadBagher et al. 2010, Screen-space percentage-closer soft shadows; Zheng and Saito 2011, Screen space "
          "anisotropic blurred soft shadows; Deligiannis 2019, sections 2.4 and 2.7",
      .glsl = "shadow/techniques/ssss.glsl",
      .needs = {"shadow_map", "least_depth_pyramid"},
      .params =
          {
              {"ssss.search_taps", 16, 1, 256, "taps", "Pixels that the blocker search reads.", compiled},
              {"ssss.taps", 32, 1, 256, "taps", "Pixels of the hard shadow that are averaged.", compiled},
              {"ssss.most_pixels", 128.0f, 1, 512, "px",
               "Radius of both kernels in the picture, at most; wider penumbrae become narrower.", uniform},
              {"ssss.edge", 1.0f, 0.01, 100, "px",
               "Distance from a receiver's plane, in widths of a pixel, up to which neighbours count fully.", uniform},
              {"ssss.turn", 30.0f, 0, 90, "deg",
               "Angle between the receiver's normal and a neighbour's up to which the neighbour counts fully.",
               uniform},
          },
      .samples = {{.name = "blocker", .count_parameter = "ssss.search_taps", .step = SampleSet::Step::blocker},
                  {.name = "filter", .count_parameter = "ssss.taps"}},
      .resolve = soften,
      .resolve_reads_motion = false,
      .programs =
          [](const ParamSet&) {
            return std::vector<gl::ProgramDesc>{
                {.name = "soften", .vertex = "shared/full_screen.vert", .fragment = "shadow/techniques/ssss.frag"},
                {.name = "soften in compute", .compute = "shadow/techniques/ssss.comp"}};
          },
      .decides_tiles = true,
      .suns_only = true,
      .stand_in = "pcss",
      .reads_light_discs = true};
}

}  // namespace penumbra::shadow
