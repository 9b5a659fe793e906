#pragma once

#include "app/render_options.h"
#include "io/report.h"
#include "studio/stage.h"
#include "studio/studio.h"

namespace penumbra::app {

// What --stats writes: what was drawn (of a sequence the last frame), with what, on what, and what each pass cost over
// the last `measured` frames.
io::Json stats_of(const RenderOptions& options, const studio::Stage& stage, const ParamSet& params,
                  studio::Studio& studio, std::size_t measured);

}  // namespace penumbra::app
