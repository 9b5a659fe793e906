#pragma once

#include <string>

#include "scene/gltf.h"
#include "studio/command_line.h"

namespace penumbra::bench {

// The whole command, under the name that it was called by ("penumbra bench"): measures, prints, writes files. Returns
// the exit code; throws UsageError or Error.
int run(const std::string& name, const studio::Arguments& arguments, const scene::ImageDecoder& decode);

}  // namespace penumbra::bench
