#pragma once

#include "app/render/options.h"
#include "io/report.h"
#include "session/prepared_scene.h"
#include "session/render_session.h"

namespace penumbra::app {

// What --stats writes: the picture that was drawn (the last frame of a sequence), its parameters, the device, and what
// each pass cost over the last `measured` frames.
io::Json stats_of(const RenderOptions& options, const session::PreparedScene& prepared, const ParamSet& params,
                  session::RenderSession& session, std::size_t measured);

}  // namespace penumbra::app
