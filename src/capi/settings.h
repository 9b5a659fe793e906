#pragma once

#include "../core/params.h"

// The object behind the C interface's pointer to settings.
struct penumbra_settings {
  penumbra::ParamSet params;
};

namespace penumbra::capi {

// The default values of all parameters.
const ParamSet& default_params();

}  // namespace penumbra::capi
