#pragma once

#include <string>

#include "../core/params.h"

// The object behind the C interface's pointer to settings.
struct penumbra_settings {
  penumbra::ParamSet params;
  std::string preset;  // that was chosen last, empty: none
};

namespace penumbra::capi {

// The default values of all parameters.
const ParamSet& default_params();

}  // namespace penumbra::capi
