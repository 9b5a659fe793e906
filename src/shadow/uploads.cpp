#include "uploads.h"

#include <vector>

#include "light_block.h"
#include "light_fit.h"

namespace penumbra::shadow {

namespace {

DepthRounding map_rounding(const LightWork& work) {
  return work.light.maps ? work.view.checked.source_of(*work.light.maps).rounding : DepthRounding{};
}

}  // namespace

void upload_light(const LightWork& work, const char* name, const glm::vec2& last_jitter, int scale) {
  const LightTraits traits{.noise = noise_read(work.params(), static_cast<int>(work.state.age)),
                           .last_jitter = last_jitter,
                           .depth_error = work.view.depth_error,
                           .vertex_rounding = work.device.vertex_rounding() / static_cast<float>(scale),
                           .made_normals = !work.view.brings_normals,
                           .moved_maps = moves_maps(work),
                           .map_rounding = map_rounding(work)};
  work.state.shadow_block = &work.device.scratch(work.prefix() + name, sizeof(glsl::ShadowBlock));
  gl::write_value(*work.state.shadow_block, shadow_block(work.inputs, work.frame, traits));
}

void upload_blocks(const LightWork& work) {
  LightState& state = work.state;
  if (!state.uploaded) {
    const std::vector<std::byte> params = uniform_bytes(state.params);
    state.params_block = &work.device.scratch(work.prefix() + "params", params.size());
    state.params_block->write(params);
    state.noise = &work.samples.noise(state.params.get_word("sampling.noise"));
  }
  upload_samples(work, work.technique, "samples");
  if (&work.forward != &work.technique) upload_samples(work, work.forward, "samples of the stand-in");
  state.uploaded = true;
  upload_light(work, "light", work.view.last_jitter);
}

}  // namespace penumbra::shadow
