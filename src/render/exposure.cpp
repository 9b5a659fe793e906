#include <cmath>

#include "render/passes.h"

namespace penumbra::render {

namespace {

constexpr GLuint exposure_binding = 0;

// Middle grey, and how far from white in the sun the automatic may go: three stops up for what lies in shade, one down.
constexpr float target_luminance = 0.18f;
constexpr float least = 0.5f, most = 8.0f;

gl::ProgramDesc program() { return {.name = "exposure", .compute = "render/exposure.comp"}; }

}  // namespace

const gl::Buffer& measure_exposure(gl::Device& device, const ExposureInputs& inputs) {
  const gl::Buffer& exposure = device.scratch("exposure", sizeof(float));
  if (!inputs.params.get_bool("exposure.auto")) {
    gl::write_value(exposure, 1.0f);
    return exposure;
  }
  const float bias = std::exp2(inputs.params.get_float("exposure.compensation"));
  gl::Pass pass(device, {.name = "exposure"});
  const gl::Program& measure = pass.use(program());
  measure.set("limits", glm::vec2(least, most));
  measure.set("target_luminance", target_luminance);
  measure.set("factor", bias);
  inputs.lit.bind(first_unit);
  inputs.gbuffer.depth->bind(first_unit + 4);
  device.sampler({}).bind(first_unit);
  device.sampler({}).bind(first_unit + 4);
  exposure.bind_storage(exposure_binding);
  pass.dispatch(1, 1);
  return exposure;
}

std::vector<gl::ProgramDesc> exposure_programs() { return {program()}; }

}  // namespace penumbra::render
