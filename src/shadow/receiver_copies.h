#pragma once

#include <array>

#include "check_inputs.h"
#include "light_state.h"

namespace penumbra::shadow {

// Receivers' textures of the caller that are layers of arrays or have samples: the other passes read copies of them,
// which are GL_TEXTURE_2D and targets of the device.

// The inputs with copies in place of such textures, and with the jitter of the samples that are copied.
Inputs with_copies(gl::Device& device, ViewState& view, const Inputs& inputs);

std::array<gl::ProgramDesc, 3> receiver_copy_programs();

}  // namespace penumbra::shadow
