#include "render/passes.h"

namespace penumbra::render {

namespace {

constexpr GLuint exposure_binding = 0;

gl::ProgramDesc program() {
  return {.name = "tone map", .vertex = "shared/full_screen.vert", .fragment = "render/tone_map.frag"};
}

}  // namespace

const gl::Texture& tone_map(gl::Device& device, const ToneMapInputs& inputs) {
  const gl::Texture& display =
      device.target("display", {.format = GL_RGBA8, .width = inputs.lit.width(), .height = inputs.lit.height()});
  gl::Pass pass(device, {.name = "tone map", .colors = {{.texture = &display, .dont_care = true}}});
  pass.use(program());
  device.sampler({}).bind(first_unit);
  inputs.lit.bind(first_unit);
  inputs.exposure.bind_storage(exposure_binding);
  pass.draw_full_screen();
  return display;
}

std::vector<gl::ProgramDesc> tone_map_programs() { return {program()}; }

}  // namespace penumbra::render
