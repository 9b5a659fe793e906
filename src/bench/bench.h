#pragma once

#include <functional>
#include <string>

#include "cli/command_line.h"
#include "scene/gltf.h"
#include "shadow/registry.h"

namespace penumbra::bench {

// The techniques that can be measured, made for that number of threads of a ray tracer (0: one for each core).
using RegistryOf = std::function<shadow::Registry(int threads)>;

// The whole command, under the name that it was called by ("penumbra bench"): measures, prints, writes files. Returns
// the exit code; throws UsageError or Error.
int run(const std::string& name, const cli::Arguments& arguments, const scene::ImageDecoder& decode,
        const RegistryOf& techniques);

}  // namespace penumbra::bench
