#pragma once

#include "app/stage.h"
#include "app/studio.h"
#include "io/report.h"

namespace penumbra::app {

// What --stats writes: what was drawn (of a sequence the last frame), with what, on what, and what each pass cost over
// the last `measured` frames.
io::Json stats_of(const RenderOptions& options, const Stage& stage, const ParamSet& params, Studio& studio,
                  std::size_t measured);

}  // namespace penumbra::app
