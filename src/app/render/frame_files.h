#pragma once

#include "app/render/options.h"
#include "cli/output_names.h"
#include "core/params.h"
#include "session/render_session.h"

namespace penumbra::app {

// Writes the last drawn frame as the options ask: one PNG for the colour picture and one for each AOV, or one EXR with
// all of them.
void write_frame(const session::RenderSession& session, const RenderOptions& options, const ParamSet& params,
                 const cli::OutputNames& names, int frame);

}  // namespace penumbra::app
