#pragma once

#include <glm/glm.hpp>
#include <string>

#include "inputs.h"

namespace penumbra::shadow {

// The most by which a depth texture's format changes a depth d when it is stored: `absolute` + `relative` · d.
struct DepthRounding {
  float absolute = 0, relative = 0;
};

// Asks OpenGL for the format of a texture that holds depth, in its depth or its red channel.
DepthRounding depth_rounding_of(unsigned texture);

// The most by which a receiver's depth in normalized device coordinates may be wrong, `absolute` + `relative` · |z|:
// by the texture's format, and by the rounding of 32-bit floats where the caller computes depths with a projection and
// where positions are computed from them.
struct NdcError {
  float absolute = 0, relative = 0;
};
NdcError ndc_error(const DepthRounding& stored, const Conventions& conventions, const glm::mat4& projection);

// A warning of one line if depths are so imprecise that positions in the middle of the receivers are off by more than
// 1/200 of their distance from the camera; else empty.
std::string depth_warning(const Inputs& inputs, const NdcError& error);

}  // namespace penumbra::shadow
