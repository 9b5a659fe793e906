#include <cmath>
#include <string>

#include "render/passes.h"

namespace penumbra::render {

namespace {

constexpr GLuint exposure_binding = 0, sums_binding = 1;

// Value of a white surface in the average light of the picture: as a photographer's incident meter has it, so that a
// grey card keeps its 18 %. The range of automatic exposure is relative to white in the sun: half a stop darker, and up
// to two and a half stops brighter for pictures in shade.
constexpr float white = 1.0f;
constexpr float least = 0.7f, most = 6.0f;

constexpr int stride = 4;            // pixels between samples
constexpr int group_samples = 2048;  // that a work group sums up

gl::ProgramDesc sums_program() {
  return {.name = "exposure sums",
          .compute = "render/exposure_sums.comp",
          .defines = {{"STRIDE", std::to_string(stride)}, {"GROUP_SAMPLES", std::to_string(group_samples)}}};
}
gl::ProgramDesc program() { return {.name = "exposure", .compute = "render/exposure.comp"}; }

int rounded_up(int count, int step) { return (count + step - 1) / step; }

}  // namespace

const gl::Buffer& measure_exposure(gl::Device& device, const ExposureInputs& inputs) {
  const gl::Buffer& exposure = device.scratch("exposure", sizeof(float));
  if (!inputs.params.get_bool("exposure.auto")) {
    gl::write_value(exposure, 1.0f);
    return exposure;
  }
  const float bias = std::exp2(inputs.params.get_float("exposure.compensation"));
  const int samples = rounded_up(inputs.lit.desc().width, stride) * rounded_up(inputs.lit.desc().height, stride);
  const int groups = rounded_up(samples, group_samples);
  const gl::Buffer& sums = device.scratch("exposure sums", static_cast<std::size_t>(groups) * sizeof(glm::vec2));
  gl::Pass pass(device, {.name = "exposure"});
  const gl::Program& sum = pass.use(sums_program());
  inputs.lit.bind(first_unit);
  inputs.gbuffer.albedo->bind(first_unit + 1);
  for (const GLuint offset : {0u, 1u}) device.sampler({}).bind(first_unit + offset);
  sums.bind_storage(sums_binding);
  pass.dispatch(groups * sum.group_size().x, 1);
  const gl::Program& measure = pass.use(program());
  measure.set("limits", glm::vec2(least, most));
  measure.set("white", white);
  measure.set("factor", bias);
  measure.set("groups", groups);
  exposure.bind_storage(exposure_binding);
  pass.dispatch(1, 1);
  return exposure;
}

std::vector<gl::ProgramDesc> exposure_programs() { return {sums_program(), program()}; }

}  // namespace penumbra::render
