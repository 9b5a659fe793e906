#pragma once

#include "core/params.h"
#include "image/write.h"
#include "render/setup.h"
#include "studio/options.h"

namespace penumbra::app {

// What an EXR file says of itself: all that it takes to draw it again.
image::Metadata metadata_of(const studio::StageOptions& options, const render::Setup& setup, const ParamSet& params,
                            int frame);

}  // namespace penumbra::app
