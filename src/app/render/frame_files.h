#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "app/render/options.h"
#include "cli/encoded_file.h"
#include "cli/output_names.h"
#include "core/params.h"
#include "session/render_session.h"

namespace penumbra::app {

// The files of the last drawn frame as the options ask: one PNG for the colour picture and one for each AOV, or one EXR
// with all of them.
std::vector<cli::EncodedFile> encoded_frame(const session::RenderSession& session, const RenderOptions& options,
                                            const ParamSet& params, const cli::OutputNames& names, int frame);

// The names of these files. `lights`: how many cast shadows.
std::vector<std::filesystem::path> frame_files(const RenderOptions& options, const cli::OutputNames& names, int frame,
                                               std::size_t lights);

// Writes these files.
void write_frame(const session::RenderSession& session, const RenderOptions& options, const ParamSet& params,
                 const cli::OutputNames& names, int frame);

}  // namespace penumbra::app
