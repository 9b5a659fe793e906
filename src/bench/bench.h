#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "cli/command_line.h"
#include "plan/job.h"
#include "scene/gltf.h"
#include "shadow/registry.h"

namespace penumbra::bench {

// The techniques that can be measured, made for that number of threads of a ray tracer (0: one for each core).
using RegistryOf = std::function<shadow::Registry(int threads)>;

// Decodes images within limits.
using DecoderOf = std::function<scene::ImageDecoder(const scene::ReadLimits& limits)>;

// The whole command, under the name that it was called by ("penumbra bench"): measures, prints, writes files. Returns
// the exit code; throws UsageError or Error.
int run(const std::string& name, const cli::Arguments& arguments, const DecoderOf& decoder,
        const RegistryOf& techniques);

// What a bench needs to read images and to trace rays.
struct Tools {
  DecoderOf decoder;
  scene::ImageProbe probe;
  RegistryOf techniques;
};

// The same work, divided into items: a point of the sweep is one, with all techniques, which are timed in turn.
// `items`: how many the plan has; absent: it is being planned, on this device. `arguments` have the value of -o at
// `output`. Null if the user asked for help.
std::unique_ptr<plan::Job> make_job(const cli::Arguments& arguments, std::size_t output, Tools tools,
                                    std::optional<std::size_t> items);

}  // namespace penumbra::bench
