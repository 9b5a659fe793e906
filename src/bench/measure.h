#pragma once

#include "bench/options.h"
#include "bench/results.h"
#include "scene/gltf.h"

namespace penumbra::bench {

// Does all that the options ask for on the context that is current. Throws Error.
Results measure(const Options& options, const scene::ImageDecoder& decode);

}  // namespace penumbra::bench
