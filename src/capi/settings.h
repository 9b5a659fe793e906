#pragma once

#include <array>
#include <string>
#include <string_view>

#include "../core/params.h"

// The object behind the C interface's pointer to settings.
struct penumbra_settings {
  penumbra::ParamSet params;
  std::string preset;  // that was chosen last, empty: none
};

namespace penumbra::capi {

// The groups of parameters that the program has and the library has not.
constexpr std::array<std::string_view, 5> groups_of_program{"casters", "exposure", "hybrid", "render", "truth"};

// The techniques and presets that need the program's scene.
constexpr std::array<std::string_view, 3> techniques_of_program{"hybrid", "hybrid_denoised", "truth"};

// The default values of all parameters.
const ParamSet& default_params();

}  // namespace penumbra::capi
