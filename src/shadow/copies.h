#pragma once

#include <array>

#include "check_inputs.h"
#include "light_state.h"

namespace penumbra::shadow {

// Textures of the caller of another kind than the other passes read: those of receivers that are layers of arrays or
// have samples, and shadow maps in an atlas or of reversed depth. Their copies are targets of the device.

// The inputs with copies in place of such textures, and with the jitter of the samples that are copied.
Inputs with_copies(gl::Device& device, ViewState& view, const Inputs& inputs);

// The layers of an atlas, or of maps that are reversed, as the library's own maps are: see shadow_map_target(). Where
// none of the maps holds all others, the last layer is one that does, made from them.
const gl::Texture& copy_maps(gl::Device& device, std::string_view name, const FinishedMaps& maps);

std::array<gl::ProgramDesc, 7> copy_programs();

}  // namespace penumbra::shadow
