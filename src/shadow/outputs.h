#pragma once

#include "check_inputs.h"
#include "light_frame.h"

namespace penumbra::shadow {

// Writes the mask to the outputs of the frame's lights, which have passed the checks: a pass for each layer that is
// written.
void write_outputs(gl::Device& device, const Inputs& inputs, const TextureChecks& checked, const gl::Texture& mask);

gl::ProgramDesc output_program();

}  // namespace penumbra::shadow
