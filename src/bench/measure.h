#pragma once

#include "bench/options.h"
#include "bench/results.h"
#include "scene/gltf.h"

namespace penumbra::bench {

// Measures everything that the options ask for, on the current context. Throws Error.
Results measure(const Options& options, const scene::ImageDecoder& decode);

}  // namespace penumbra::bench
