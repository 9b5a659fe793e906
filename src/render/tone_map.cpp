#include <bit>
#include <span>
#include <vector>

#include "render/passes.h"
#include "shadow/noise.h"

namespace penumbra::render {

namespace {

constexpr GLuint exposure_binding = 0;
constexpr GLuint noise_unit = first_unit + 1;

gl::ProgramDesc program() {
  return {.name = "tone map", .vertex = "shared/full_screen.vert", .fragment = "render/tone_map.frag"};
}

}  // namespace

gl::Texture dither_noise() {
  static_assert(std::has_single_bit(unsigned{shadow::built_in_noise_side}), "render/encode.glsl repeats it by a mask");
  const shadow::NoiseTile tile = shadow::built_in_noise("void_and_cluster");
  std::vector<float> values;
  for (int pixel = 0; pixel < tile.count(); ++pixel) values.push_back(tile.value(pixel, 0));
  gl::Texture texture("dither noise", {.format = GL_R32F, .width = tile.size, .height = tile.size});
  texture.upload(GL_RED, GL_FLOAT, std::as_bytes(std::span(values)));
  return texture;
}

const gl::Texture& tone_map(gl::Device& device, const ToneMapInputs& inputs) {
  const gl::Texture& display =
      device.target("display", {.format = GL_RGBA8, .width = inputs.lit.width(), .height = inputs.lit.height()});
  gl::Pass pass(device, {.name = "tone map", .colors = {{.texture = &display, .dont_care = true}}});
  pass.use(program()).set("dither", inputs.params.get_bool("render.dither") ? 1.0f : 0.0f);
  for (const GLuint unit : {first_unit, noise_unit}) device.sampler({}).bind(unit);
  inputs.lit.bind(first_unit);
  inputs.noise.bind(noise_unit);
  inputs.exposure.bind_storage(exposure_binding);
  pass.draw_full_screen();
  return display;
}

std::vector<gl::ProgramDesc> tone_map_programs() { return {program()}; }

}  // namespace penumbra::render
