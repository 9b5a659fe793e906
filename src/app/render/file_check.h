#pragma once

#include <filesystem>
#include <vector>

#include "app/render/options.h"
#include "cli/output_names.h"

namespace penumbra::app {

// Before minutes of drawing: is what was named there, can every result be written, and does none take the place of
// another or of what is read? Throws Error, UsageError where no file could make it right.
void check_files(const RenderOptions& options, const cli::OutputNames& names);

// Once the scene is read: throws UsageError if a result would take the place of one of its files.
void check_scene_files(const std::vector<std::filesystem::path>& files, const RenderOptions& options,
                       const cli::OutputNames& names);

}  // namespace penumbra::app
