#pragma once

#include "light_state.h"
#include "programs.h"
#include "registry.h"
#include "samples.h"

namespace penumbra::shadow {

struct Tiles;

// One light of one view in one frame: the data that the steps of frame.cpp pass on to each other.
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
  const Technique& forward;                      // used for blended surfaces: the technique itself, or its stand-in
  const Denoiser* denoiser = nullptr;            // null where none applies
  std::vector<Denoiser::Remembered> remembered;  // what the denoiser keeps for the next frame
  const Tiles* tiles = nullptr;                  // of the mask, if they are decided already

  const ParamSet& params() const { return state.params; }
  const std::string& prefix() const { return state.prefix; }  // of the names of targets and buffers
};

// The technique that is used for blended surfaces.
const Technique& forward_technique(const Registry& registry, const ParamSet& params);
// The denoiser that the parameters choose; null if there is none, if it does nothing with these parameters, or if the
// technique is not denoisable.
const Denoiser* denoiser_for(const Registry& registry, const Technique& technique, const ParamSet& params);
std::vector<Denoiser::Remembered> remembered_by(const Denoiser* denoiser, const ParamSet& params);

// Whether a technique reads the second layer of the map (product second_layer): ever, and with these parameters.
bool needs_second_layer(const Technique& technique);
bool reads_second_layer(const Technique& technique, const ParamSet& params);
// Whether it finds the shadows of casters that the first layer does not show.
bool sees_hidden_casters(const Technique& technique, const ParamSet& params);

// Null if this frame made no product of that name.
const Product* find_product(const LightFrame& frame, std::string_view name);

// Writes the sample points of a technique that this frame reads, unless its buffer has them. `name`: of that buffer.
void upload_samples(const LightWork& work, const Technique& technique, const char* name);

// Binds what every program of the owner reads, except the receivers: uniform blocks, maps, noise, products.
void bind_light(gl::Device& device, const LightFrame& frame, const LightState& state, const PassOwner& owner);
// The texture of the receivers' normals: the caller's, or those that were made from depths; 0: not made yet.
GLuint normals_of(const LightWork& work);
// Binds the receivers' depth and normals.
void bind_receivers(const LightWork& work);
// Both.
void bind_inputs(const LightWork& work, const PassOwner& owner);

// The beginning of the names of all targets and buffers of an owner.
std::string target_prefix(const LightWork& work, const PassOwner& owner);

PassOwner owner_of(const Technique& technique);
PassOwner owner_of(const Recipe& recipe);
PassOwner owner_of(const Denoiser& denoiser);

}  // namespace penumbra::shadow
