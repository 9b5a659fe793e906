#pragma once

#include "cli/options.h"
#include "core/params.h"
#include "image/write.h"
#include "render/setup.h"

namespace penumbra::app {

// The metadata of an EXR file: everything needed to draw it again.
image::Metadata metadata_of(const cli::SceneOptions& options, const render::Setup& setup, const ParamSet& params,
                            int frame);

}  // namespace penumbra::app
