#pragma once

#include <string>

#include "cli/command_line.h"
#include "scene/gltf.h"

namespace penumbra::bench {

// The whole command, under the name that it was called by ("penumbra bench"): measures, prints, writes files. Returns
// the exit code; throws UsageError or Error.
int run(const std::string& name, const cli::Arguments& arguments, const scene::ImageDecoder& decode);

}  // namespace penumbra::bench
