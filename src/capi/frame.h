#pragma once

#include <vector>

#include "../shadow/inputs.h"
#include "device.h"

namespace penumbra::capi {

shadow::Light light_of(const penumbra_light& light);
// `inputs`: of the frame, whose lights may bring maps; null: maps are left out.
std::vector<shadow::Light> lights_of(const penumbra_light* lights, std::size_t count,
                                     const shadow::Inputs* inputs = nullptr);

// All but the lights and the caster callback.
shadow::Inputs inputs_of(const penumbra_frame& frame);

// The caster callback as the library calls it. `device`: keeps the texts of shaders.
shadow::DrawCasters casters_of(const penumbra_frame& frame, penumbra_device& device);

}  // namespace penumbra::capi
