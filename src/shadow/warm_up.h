#pragma once

#include <string>
#include <vector>

#include "../gl/device.h"
#include "soft_shadows.h"

namespace penumbra::shadow {

// The lights of a frame of that kind. Outputs are layers of a texture of the small frame's size.
std::vector<Light> warm_up_lights(gl::Device& device, const std::string& prefix, const FrameKind& kind);

// Inputs of a small frame of that kind: a plane that fills the picture, a part of it in the shadow of one caster. Their
// textures are targets of the device that begin with `prefix`.
Inputs warm_up_inputs(gl::Device& device, const std::string& prefix, const FrameKind& kind);

// The same without normals, and with depths in an array.
Inputs other_warm_up_inputs(gl::Device& device, const std::string& prefix, const FrameKind& kind);

gl::ProgramDesc warm_up_caster_program();

}  // namespace penumbra::shadow
