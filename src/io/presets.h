#pragma once

#include <filesystem>

#include "core/params.h"
#include "core/preset.h"

namespace penumbra::io {

// Applies a preset file to `params`, as apply_preset() does. Throws Error also for a file that can't be read or is
// empty, and for a pipe that no program writes to.
void read_preset(const std::filesystem::path& path, ParamSet& params, const SelectTechnique& select);

// Writes preset_text() to a file.
void write_preset(const std::filesystem::path& path, const ParamSet& params);

}  // namespace penumbra::io
