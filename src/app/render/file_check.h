#pragma once

#include <filesystem>
#include <vector>

#include "app/render/options.h"
#include "cli/output_names.h"

namespace penumbra::app {

// Called before drawing, which can take minutes. Checks that the results can be written and that none would overwrite
// another one or a file that is only read. Throws Error, or UsageError if the command line is wrong.
void check_files(const RenderOptions& options, const cli::OutputNames& names);

// Called once the scene is read. Throws UsageError if a result would overwrite one of its files.
void check_scene_files(const std::vector<std::filesystem::path>& files, const RenderOptions& options,
                       const cli::OutputNames& names);

}  // namespace penumbra::app
