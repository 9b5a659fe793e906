#pragma once

#include "app/render/options.h"
#include "cli/output_names.h"
#include "core/params.h"
#include "session/render_session.h"

namespace penumbra::app {

// Writes the last frame drawn as the options ask: one PNG and one an AOV, or one EXR. The colour picture is always
// among them.
void write_frame(const session::RenderSession& session, const RenderOptions& options, const ParamSet& params,
                 const cli::OutputNames& names, int frame);

}  // namespace penumbra::app
