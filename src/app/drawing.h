#pragma once

#include <cstddef>
#include <functional>

#include "app/output_names.h"
#include "app/render_options.h"
#include "core/params.h"
#include "studio/stage.h"
#include "studio/studio.h"

namespace penumbra::app {

// What `render` and `watch` share.

// Draws the frames of a range after the options' warm-up, and gives each to `drawn`.
void draw_frames(const RenderOptions& options, studio::Studio& studio, const ParamSet& params,
                 const studio::FrameRange& range, const std::function<void(int frame)>& drawn);

// How many of the last frames count for costs. Draws a single picture again to measure it; of a sequence it counts what
// was drawn. The first draw compiles shaders and never counts.
std::size_t measure(const RenderOptions& options, studio::Studio& studio, const ParamSet& params,
                    const studio::FrameRange& range);

// Writes what --stats and --save-preset ask for.
void write_reports(const RenderOptions& options, const studio::Stage& stage, const ParamSet& params,
                   studio::Studio& studio, std::size_t measured);

}  // namespace penumbra::app
