#pragma once

#include <string>

#include "light_state.h"

namespace penumbra::shadow {

struct MapsInputs {
  const Inputs& inputs;
  const Light& light;
  const LightState& state;  // of this frame
  unsigned needs = needs_nothing;
  std::string prefix;  // of names
};

// Where the light's maps lie: as the caller brings them, or fitted to the view.
LightProjection projection_of(const Inputs& inputs, const Light& light, const ParamSet& params);

// Draws or takes a light's maps, and makes what is made of them, as far as `needs` and the history ask: `frame` has the
// projection and gets the rest.
void make_maps(gl::Device& device, const MapsInputs& inputs, LightFrame& frame);

}  // namespace penumbra::shadow
