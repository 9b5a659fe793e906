#pragma once

#include "cli/options.h"
#include "core/params.h"
#include "image/write.h"
#include "render/setup.h"

namespace penumbra::app {

// What an EXR file says of itself: all that it takes to draw it again.
image::Metadata metadata_of(const cli::SceneOptions& options, const render::Setup& setup, const ParamSet& params,
                            int frame);

}  // namespace penumbra::app
