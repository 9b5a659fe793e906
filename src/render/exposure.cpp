#include <cmath>

#include "render/passes.h"

namespace penumbra::render {

namespace {

constexpr GLuint exposure_binding = 0;

// Value of a white surface in the average light of the picture: as a photographer's incident meter has it, so that a
// grey card keeps its 18 %. The range of automatic exposure is relative to white in the sun: half a stop darker, and up
// to two and a half stops brighter for pictures in shade.
constexpr float white = 1.0f;
constexpr float least = 0.7f, most = 6.0f;

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
  measure.set("white", white);
  measure.set("factor", bias);
  inputs.lit.bind(first_unit);
  inputs.gbuffer.albedo->bind(first_unit + 1);
  for (const GLuint offset : {0u, 1u}) device.sampler({}).bind(first_unit + offset);
  exposure.bind_storage(exposure_binding);
  pass.dispatch(1, 1);
  return exposure;
}

std::vector<gl::ProgramDesc> exposure_programs() { return {program()}; }

}  // namespace penumbra::render
