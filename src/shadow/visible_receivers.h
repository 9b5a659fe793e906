#pragma once

#include <optional>
#include <string>
#include <vector>

#include "inputs.h"

namespace penumbra::shadow {

// What the view's depth texture shows of the receivers, for a light whose maps are fitted to it (cascades.fit). Absent
// where the maps are not, and where only sky is seen. The CPU waits for the GPU to finish all earlier work: the
// matrices that casters are drawn with depend on the result. `prefix`: of the names of the light's buffers.
// `decisions`: of Tiles; what is shown in decided ones is left out.
std::optional<VisibleReceivers> find_visible_receivers(gl::Device& device, const Inputs& inputs, const Light& light,
                                                       const ParamSet& params, const std::string& prefix,
                                                       const gl::Texture* decisions = nullptr);

std::vector<gl::ProgramDesc> visible_receivers_programs();

}  // namespace penumbra::shadow
