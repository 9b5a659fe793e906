#pragma once

#include "app/output_names.h"
#include "app/render_options.h"
#include "core/params.h"
#include "studio/studio.h"

namespace penumbra::app {

// Writes the last frame drawn as the options ask: one PNG and one an AOV, or one EXR. The colour picture is always
// among them.
void write_frame(const studio::Studio& studio, const RenderOptions& options, const ParamSet& params,
                 const OutputNames& names, int frame);

}  // namespace penumbra::app
