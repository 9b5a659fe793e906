#include "render/passes.h"

namespace penumbra::render {

namespace {

gl::ProgramDesc program() {
  return {.name = "sample mask", .vertex = "shared/full_screen.vert", .fragment = "render/sample_mask.frag"};
}

}  // namespace

shadow::Mask draw_sample_mask(gl::Device& device, const SampleMaskInputs& inputs) {
  const gl::Texture& texture = device.target("sample mask", inputs.mask.texture->desc());
  for (int light = 0; light < static_cast<int>(inputs.mask.lights.size()); ++light) {
    gl::Pass pass(device,
                  {.name = "sample mask", .colors = {{.texture = &texture, .layer = light, .dont_care = true}}});
    const gl::Program& used = pass.use(program());
    used.set("clip_to_world", clip_to_world(inputs.view));
    set_first_sample(used, inputs.first);
    used.set("light", light);
    GLuint unit = first_unit;
    for (const gl::Texture* source : {inputs.mask.texture, inputs.gbuffer.depth, inputs.gbuffer.geometric_normal,
                                      inputs.first.gbuffer.depth, inputs.first.gbuffer.geometric_normal}) {
      device.sampler({}).bind(unit);
      source->bind(unit++);
    }
    pass.draw_full_screen();
  }
  shadow::Mask mask = inputs.mask;
  mask.texture = &texture;
  return mask;
}

std::vector<gl::ProgramDesc> sample_mask_programs() { return {program()}; }

}  // namespace penumbra::render
