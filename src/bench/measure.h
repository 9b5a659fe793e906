#pragma once

#include "bench/options.h"
#include "bench/results.h"
#include "scene/gltf.h"
#include "shadow/registry.h"

namespace penumbra::bench {

// Measures everything that the options ask for, of techniques of the registry, on the current context. Throws Error.
Results measure(const Options& options, const scene::ImageDecoder& decode, const shadow::Registry& registry);

}  // namespace penumbra::bench
