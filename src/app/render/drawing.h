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

// Draws the frames of a range after the options' warm-up, and gives each to `drawn`.
void draw_frames(const RenderOptions& options, session::RenderSession& session, const ParamSet& params,
                 const cli::FrameRange& range, const std::function<void(int frame)>& drawn);

// How many of the last frames count for costs. Draws a single picture again to measure it; of a sequence it counts what
// was drawn. The first draw compiles shaders and never counts.
std::size_t measure(const RenderOptions& options, session::RenderSession& session, const ParamSet& params,
                    const cli::FrameRange& range);

// Writes what --stats and --save-preset ask for.
void write_reports(const RenderOptions& options, const session::PreparedScene& prepared, const ParamSet& params,
                   session::RenderSession& session, std::size_t measured);

}  // namespace penumbra::app
