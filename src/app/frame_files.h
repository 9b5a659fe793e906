#pragma once

#include "app/output_names.h"
#include "app/stage.h"
#include "core/params.h"
#include "render/renderer.h"

namespace penumbra::app {

// Writes the renderer's last frame as the options ask: one PNG and one an AOV, or one EXR. The colour picture is always
// among them.
void write_frame(const render::Renderer& renderer, const RenderOptions& options, const Stage& stage,
                 const ParamSet& params, const OutputNames& names, int frame);

}  // namespace penumbra::app
