// The mean of several samples of each pixel. Samples are averaged after the tone map, in linear light of the display:
// an edge between dark and dazzling surfaces would stay a staircase if the mean of its radiances were mapped, since the
// smallest share of the dazzling one is already white.
#include <vector>

#include "render/passes.h"
#include "shadow/sampling.h"

namespace penumbra::render {

namespace {

constexpr GLuint exposure_binding = 0;
constexpr GLuint noise_unit = first_unit + 1;

gl::ProgramDesc add_program() {
  return {.name = "add sample", .vertex = "shared/full_screen.vert", .fragment = "render/add_sample.frag"};
}

gl::ProgramDesc encode_program() {
  return {.name = "encode mean", .vertex = "shared/full_screen.vert", .fragment = "render/encode_mean.frag"};
}

}  // namespace

std::vector<glm::vec2> sample_offsets(int count) {
  std::vector<glm::vec2> offsets = shadow::square_points("halton", count);
  const glm::vec2 first = offsets.front();
  for (glm::vec2& offset : offsets) offset = glm::fract(offset - first + 0.5f) - 0.5f;
  return offsets;
}

SampleMean add_sample(gl::Device& device, const SampleInputs& inputs) {
  const auto target = [&](const char* name) {
    return &device.target(name, {.format = GL_RGBA32F, .width = inputs.lit.width(), .height = inputs.lit.height()});
  };
  const SampleMean mean{.display = target("mean display"), .color = target("mean color")};
  const auto attachment = [&](const gl::Texture* texture) {
    gl::Attachment kept{.texture = texture};
    if (inputs.index == 0) kept.clear = glm::vec4(0);
    return kept;
  };
  gl::Pass pass(
      device,
      {.name = "add sample", .colors = {attachment(mean.display), attachment(mean.color)}, .blend = gl::Blend::add});
  pass.use(add_program()).set("share", 1.0f / static_cast<float>(inputs.count));
  device.sampler({}).bind(first_unit);
  inputs.lit.bind(first_unit);
  inputs.exposure.bind_storage(exposure_binding);
  pass.draw_full_screen();
  return mean;
}

const gl::Texture& encode_mean(gl::Device& device, const EncodeInputs& inputs) {
  const gl::Texture& display = device.target(
      "display", {.format = GL_RGBA8, .width = inputs.display.width(), .height = inputs.display.height()});
  gl::Pass pass(device, {.name = "encode mean", .colors = {{.texture = &display, .dont_care = true}}});
  pass.use(encode_program()).set("dither", inputs.params.get_bool("render.dither") ? 1.0f : 0.0f);
  for (const GLuint unit : {first_unit, noise_unit}) device.sampler({}).bind(unit);
  inputs.display.bind(first_unit);
  inputs.noise.bind(noise_unit);
  pass.draw_full_screen();
  return display;
}

std::vector<gl::ProgramDesc> sample_programs() { return {add_program(), encode_program()}; }

}  // namespace penumbra::render
