#pragma once

#include "light_state.h"
#include "programs.h"
#include "registry.h"
#include "samples.h"

namespace penumbra::shadow {

// One light of one view in one frame, on its way through the steps of frame.cpp.
struct LightWork {
  gl::Device& device;
  const Registry& registry;
  const Programs& programs;
  Samples& samples;
  const Inputs& inputs;
  const Light& light;
  const gl::Texture& mask;
  const ViewState& view;
  LightState& state;
  LightFrame& frame;
  const Technique& technique;
  const Technique& forward;                      // serves blended surfaces: the technique itself, or its stand-in
  const Denoiser* denoiser = nullptr;            // null where none applies
  std::vector<Denoiser::Remembered> remembered;  // by the denoiser, under the parameters of this frame

  const ParamSet& params() const { return state.params; }
  const std::string& prefix() const { return state.prefix; }  // of the names of targets and buffers
};

// The technique that serves blended surfaces.
const Technique& forward_technique(const Registry& registry, const ParamSet& params);
// The denoiser that the parameters choose, if it applies under them to what the technique computes; else null.
const Denoiser* denoiser_for(const Registry& registry, const Technique& technique, const ParamSet& params);
std::vector<Denoiser::Remembered> remembered_by(const Denoiser* denoiser, const ParamSet& params);

// Null where nothing of that name was made in this frame.
const Product* find_product(const LightFrame& frame, std::string_view name);

// Binds what every program of the owner reads but receivers: blocks, maps, noise, products.
void bind_light(gl::Device& device, const LightFrame& frame, const LightState& state, const PassOwner& owner);
// The same, and the receivers.
void bind_inputs(const LightWork& work, const PassOwner& owner);

PassOwner owner_of(const Technique& technique);
PassOwner owner_of(const Recipe& recipe);
PassOwner owner_of(const Denoiser& denoiser);

}  // namespace penumbra::shadow
