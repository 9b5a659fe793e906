#pragma once

#include <cstddef>
#include <functional>

#include "app/render/options.h"
#include "cli/output_names.h"
#include "core/params.h"
#include "session/prepared_scene.h"
#include "session/render_session.h"

namespace penumbra::app {

// What `render` and `watch` share.

// Draws the warm-up frames that the options ask for, then the frames of `range`, and calls `drawn` after each frame of
// the range.
void draw_frames(const RenderOptions& options, session::RenderSession& session, const ParamSet& params,
                 const cli::FrameRange& range, const std::function<void(int frame)>& drawn);

// Returns how many of the last drawn frames the costs are taken from. A single picture is drawn again, as often as
// --stats-frames says, with all shadow maps drawn anew; a sequence is not drawn again. The first draw never counts,
// because it compiles shaders.
std::size_t measure(const RenderOptions& options, session::RenderSession& session, const ParamSet& params,
                    const cli::FrameRange& range);

// Writes what --stats and --save-preset ask for.
void write_reports(const RenderOptions& options, const session::PreparedScene& prepared, const ParamSet& params,
                   session::RenderSession& session, std::size_t measured);

}  // namespace penumbra::app
